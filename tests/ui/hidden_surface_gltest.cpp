#include "ui/id_comparison.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <cstring>
#include <vector>

using namespace octant;

namespace {

visuals::gl::Picture picture_of(int width, int height, const std::vector<std::uint32_t>& ids) {
    visuals::gl::Picture picture;
    picture.width = width;
    picture.height = height;
    picture.rgba.resize(4 * ids.size());
    std::memcpy(picture.rgba.data(), ids.data(), picture.rgba.size());
    return picture;
}

ui::IdComparison
compare(const char* path, const char* aircraft, visuals::scene::View view, const char* terrain) {
    visuals::scene::Settings settings;
    settings.path = path;
    settings.aircraft = {aircraft};
    settings.view = view;
    settings.terrain = terrain;
    settings.size_px = {320, 240};
    settings.triangles = 8000;
    constexpr int every = 150;
    return ui::compare_with_depth_buffer(settings, every, [](int, int) {});
}

} // namespace

TEST_CASE("a polygon number is wrong only when no neighbour in the reference has it") {
    const auto reference = picture_of(4, 3, {1, 1, 2, 2, 1, 1, 2, 2, 3, 3, 3, 3});
    CHECK(ui::difference_of(reference, reference).differing == 0);
    const auto shifted = picture_of(4, 3, {1, 2, 2, 2, 1, 1, 2, 2, 3, 3, 3, 3});
    CHECK(ui::difference_of(shifted, reference).differing == 1);
    CHECK(ui::difference_of(shifted, reference).wrong == 0);
    const auto far_off = picture_of(4, 3, {1, 1, 2, 1, 1, 1, 2, 2, 3, 3, 3, 3});
    CHECK(ui::difference_of(far_off, reference).wrong == 1);
}

TEST_CASE("painting in order shows the polygons that the depth buffer shows, over rugged ground") {
    using visuals::scene::View;
    for (const View view : {View::Chase, View::Tower, View::Orbit}) {
        for (const char* aircraft : {"f15", "500md"}) {
            for (const char* path : {"jinking", "pop-up"}) {
                INFO(aircraft << " " << path << " view " << static_cast<int>(view));
                const ui::IdComparison result = compare(path, aircraft, view, "canyon");
                CHECK(result.frames > 5);
                CHECK(result.unordered == 0);
                CHECK(result.difference.wrong == 0);
            }
        }
    }
}
