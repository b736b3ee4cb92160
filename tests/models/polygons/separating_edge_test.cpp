#include "models/polygons/separating_edge.h"

#include <catch2/catch.hpp>

#include <vector>

using octant::models::polygons::has_separating_edge;

namespace {

using Corners = std::vector<glm::dvec3>;

const glm::dvec3 up(0, 0, 1);
const Corners wide_square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};

Corners moved(Corners corners, double east) {
    for (glm::dvec3& corner : corners) { corner.x += east; }
    return corners;
}

} // namespace

TEST_CASE("an edge parts a square from one that touches it, and from none that overlaps it") {
    CHECK(has_separating_edge(wide_square, up, moved(wide_square, 2.0), 0.0));
    CHECK(has_separating_edge(wide_square, up, moved(wide_square, 3.0), 0.0));
    CHECK_FALSE(has_separating_edge(wide_square, up, moved(wide_square, 1.5), 0.0));
    CHECK(has_separating_edge(wide_square, up, moved(wide_square, 1.5), 0.5));
    CHECK_FALSE(has_separating_edge(wide_square, up, moved(wide_square, 1.4), 0.5));
}

TEST_CASE("where no edge of one outline parts them, one of the other may") {
    const Corners at_a_corner{{2.5, 1.5, 0}, {3, 3, 0}, {1.5, 2.5, 0}};
    CHECK_FALSE(has_separating_edge(wide_square, up, at_a_corner, 0.0));
    CHECK(has_separating_edge(at_a_corner, up, wide_square, 0.0));
}
