#include "models/polygons/edge_parts.h"

#include <catch2/catch.hpp>

#include <vector>

using octant::models::polygons::edge_parts;

namespace {

using Corners = std::vector<glm::dvec3>;

const glm::dvec3 up(0, 0, 1);
const Corners square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};

Corners moved(Corners corners, double east) {
    for (glm::dvec3& corner : corners) {
        corner.x += east;
    }
    return corners;
}

} // namespace

TEST_CASE("an edge parts a square from one that touches it, and from none that overlaps it") {
    CHECK(edge_parts(square, up, moved(square, 2.0), 0.0));
    CHECK(edge_parts(square, up, moved(square, 3.0), 0.0));
    CHECK_FALSE(edge_parts(square, up, moved(square, 1.5), 0.0));
    CHECK(edge_parts(square, up, moved(square, 1.5), 0.5));
    CHECK_FALSE(edge_parts(square, up, moved(square, 1.4), 0.5));
}

TEST_CASE("where no edge of one outline parts them, one of the other may") {
    const Corners at_a_corner{{2.5, 1.5, 0}, {3, 3, 0}, {1.5, 2.5, 0}};
    CHECK_FALSE(edge_parts(square, up, at_a_corner, 0.0));
    CHECK(edge_parts(at_a_corner, up, square, 0.0));
}
