#include <octant/octant.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <vector>

int main() {
    octant::World world({.terrain = "hills", .aircraft = {"f15"}});
    std::vector<octant::Pose> poses = {{.eye_m = {0, -500, 400}, .attitude = octant::attitude(/*heading_deg*/ 0, /*pitch_deg*/ -10)}};
    octant::Frames frames = world.render(octant::Camera{128, 128, 60.0}, poses, octant::Output::Rgb | octant::Output::Depth);

    const bool is_drawn = frames.rgb.size() == 128 * 128 * 3 && frames.depth_m.size() == 128 * 128 &&
                          std::ranges::adjacent_find(frames.rgb, std::ranges::not_equal_to()) != frames.rgb.end();
    try {
        octant::World wrong({.terrain = "no-such-map.tif"});
    } catch (const octant::Error& fault) {
        std::cout << octant::version() << '\n' << fault.what() << '\n';
        return is_drawn ? 0 : 1;
    }
    return 1;
}
