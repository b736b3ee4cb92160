#include "visuals/overlay/overlay.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace octant::visuals::overlay;
using namespace octant::visuals::scene;

namespace {

constexpr glm::ivec2 marks_px(800, 600);

const Camera north = camera_looking_at({0.0, 0.0, 0.0}, {0.0, 100.0, 0.0});

std::size_t corners_of(std::span<const WorldLabel> labels) {
    OverlayCanvas canvas;
    return draw_path_annotations(canvas, north, marks_px, {0.0, 100.0, 0.0}, labels).vertices.size();
}

} // namespace

TEST_CASE("north mark and scale are drawn, names only before the eye and near enough") {
    const std::size_t bare = corners_of({});
    CHECK(bare > 50);
    const auto corners_at = [](const glm::dvec3& at_m) {
        const WorldLabel label{at_m, "turn"};
        return corners_of(std::span(&label, 1));
    };
    CHECK(corners_at({10.0, 200.0, 5.0}) > bare);
    CHECK(corners_at({10.0, -200.0, 5.0}) == bare);
    CHECK(corners_at({10.0, 20000.0, 5.0}) == bare);
}

TEST_CASE("the scale is a round length of what is as far as the aircraft") {
    const auto right_px = [](double aircraft_m) {
        OverlayCanvas canvas;
        const OverlayDraw draw = draw_path_annotations(canvas, north, marks_px, {0.0, aircraft_m, 0.0}, {});
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
