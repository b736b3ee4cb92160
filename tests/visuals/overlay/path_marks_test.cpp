#include "visuals/overlay/path_marks.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace octant::visuals::overlay;
using namespace octant::visuals::scene;

namespace {

constexpr glm::ivec2 marks_px(800, 600);

std::size_t corners_of(const glm::dvec3& look, const PlaceName* place) {
    PathMarks marks;
    const Camera camera = camera_looking_at({0.0, 0.0, 0.0}, look);
    marks.begin(camera, marks_px, {0.0, 100.0, 0.0});
    if (place != nullptr) {
        marks.add(*place);
    }
    return marks.finish().vertices.size();
}

} // namespace

TEST_CASE("north mark and scale are drawn, names only before the eye and near enough") {
    const glm::dvec3 north(0.0, 100.0, 0.0);
    const std::size_t bare = corners_of(north, nullptr);
    CHECK(bare > 50);
    const PlaceName ahead{{10.0, 200.0, 5.0}, "turn"};
    const PlaceName behind{{10.0, -200.0, 5.0}, "turn"};
    const PlaceName far{{10.0, 20000.0, 5.0}, "turn"};
    CHECK(corners_of(north, &ahead) > bare);
    CHECK(corners_of(north, &behind) == bare);
    CHECK(corners_of(north, &far) == bare);
}
