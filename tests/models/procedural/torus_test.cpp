#include "models/polygons/polygon_model.h"
#include "models/procedural/background60.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>

using namespace octant::models;
using namespace octant::models::procedural;
using namespace octant::models::polygons;

TEST_CASE("the torus has 416 quads and vertices, all quads convex and planar") {
    const PolygonModel model = torus();
    CHECK(model.polygons.size() == 416);
    CHECK(model.vertices_m.size() == 416);
    CHECK(radius_m(model) == Approx(1.4));
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        CHECK(model.polygons[i].corner_count == 4);
        CHECK_FALSE(polygon_fault(model, i, 1e-12).has_value());
    }
}

TEST_CASE("every quad of the torus faces away from the middle of its tube") {
    const PolygonModel model = torus(12, 7);
    REQUIRE(model.polygons.size() == 84);
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        glm::dvec3 middle_m(0.0);
        for (const std::uint32_t vertex : model.corners(i)) { middle_m += model.vertices_m[vertex] / 4.0; }
        const glm::dvec3 ring_m = glm::normalize(glm::dvec3(middle_m.x, middle_m.y, 0.0));
        CHECK(glm::dot(normal_of(model, i), middle_m - ring_m) > 0.3);
    }
}

TEST_CASE("the torus is closed: each side belongs to two quads that run along it oppositely") {
    const PolygonModel model = torus(5, 4);
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        for (std::size_t side = 0; side < 4; ++side) {
            const std::uint32_t from = model.corners(i)[side];
            const std::uint32_t to = model.corners(i)[(side + 1) % 4];
            int twins = 0;
            for (std::size_t j = 0; j < model.polygons.size(); ++j) {
                for (std::size_t k = 0; k < 4; ++k) {
                    const bool twin = model.corners(j)[k] == to && model.corners(j)[(k + 1) % 4] == from;
                    twins += twin ? 1 : 0;
                }
            }
            CHECK(twins == 1);
        }
    }
}
