#include "visuals/overlay/path_annotations.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace octant::visuals::overlay;
using namespace octant::visuals::scene;

namespace {

constexpr glm::ivec2 marks_px(800, 600);

std::size_t corners_of(const glm::dvec3& look, const WorldLabel* place) {
    PathAnnotations marks;
    const Camera camera = camera_looking_at({0.0, 0.0, 0.0}, look);
    marks.begin(camera, marks_px, {0.0, 100.0, 0.0});
    if (place != nullptr) { marks.add(*place); }
    return marks.finish().vertices.size();
}

} // namespace

TEST_CASE("north mark and scale are drawn, names only before the eye and near enough") {
    const glm::dvec3 north(0.0, 100.0, 0.0);
    const std::size_t bare = corners_of(north, nullptr);
    CHECK(bare > 50);
    const WorldLabel ahead{{10.0, 200.0, 5.0}, "turn"};
    const WorldLabel behind{{10.0, -200.0, 5.0}, "turn"};
    const WorldLabel far{{10.0, 20000.0, 5.0}, "turn"};
    CHECK(corners_of(north, &ahead) > bare);
    CHECK(corners_of(north, &behind) == bare);
    CHECK(corners_of(north, &far) == bare);
}

TEST_CASE("the scale is a round length of what is as far as the aircraft") {
    const auto right_px = [](double aircraft_m) {
        PathAnnotations marks;
        const Camera camera = camera_looking_at({0.0, 0.0, 0.0}, {0.0, 100.0, 0.0});
        marks.begin(camera, marks_px, {0.0, aircraft_m, 0.0});
        const OverlayDraw draw = marks.finish();
        float right = 0.0F; // of what stands below the north mark: the scale and its caption
        for (const OverlayVertex& vertex : draw.vertices) {
            right = std::max(right, vertex.at_px.y > 560.0F ? vertex.at_px.x : 0.0F);
        }
        return right;
    };
    // 10 m at 100 m, 1 km at 10,000 m: the same length in the picture.
    CHECK(right_px(100.0) == Approx(right_px(10000.0)).margin(1.0));
    CHECK(right_px(100.0) > 100.0F);
    CHECK(right_px(100.0) < 260.0F);
    CHECK(right_px(90.0) > right_px(100.0) + 5.0F); // nearer things are larger
}
