#include "models/polygons/polygon_model.h"
#include "models/procedural/procedural_models.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <map>
#include <utility>

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

TEST_CASE("the machined part is closed, of one piece without handles, and seen from outside") {
    const TriangleMesh part = machined_part();
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    double six_volumes_m3 = 0.0;
    for (const Triangle& corners : part.triangles) {
        for (std::size_t i = 0; i < 3; ++i) { ++sides[{corners[i], corners[(i + 1) % 3]}]; }
        const auto& at = part.vertices_m;
        six_volumes_m3 += glm::dot(at[corners[0]], glm::cross(at[corners[1]], at[corners[2]]));
    }
    for (const auto& [side, count] : sides) {
        REQUIRE(count == 1);
        REQUIRE(sides.contains({side.second, side.first}));
    }
    CHECK(part.vertices_m.size() + part.triangles.size() == sides.size() / 2 + 2);
    CHECK(six_volumes_m3 / 6.0 == Approx(2.6e-4).epsilon(0.2));
}

TEST_CASE("the machined part has flats, curved sides and sharp edges between them") {
    const TriangleMesh part = machined_part();
    CHECK(part.triangles.size() > 30'000);
    CHECK(diagonal_m(part) == Approx(0.15).epsilon(0.1));
    const auto normal_of = [&](const Triangle& corners) {
        const auto& at = part.vertices_m;
        return glm::normalize(glm::cross(at[corners[1]] - at[corners[0]], at[corners[2]] - at[corners[0]]));
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, glm::dvec3> normals;
    for (const Triangle& corners : part.triangles) {
        for (std::size_t i = 0; i < 3; ++i) { normals[{corners[i], corners[(i + 1) % 3]}] = normal_of(corners); }
    }
    std::size_t flat = 0;
    std::size_t sharp = 0;
    for (const auto& [side, normal] : normals) {
        const double cosine = glm::dot(normal, normals.at({side.second, side.first}));
        flat += cosine > 1.0 - 1e-9 ? 1U : 0U;
        sharp += cosine < 0.7 ? 1U : 0U;
    }
    CHECK(static_cast<double>(flat) > 0.5 * static_cast<double>(normals.size()));
    CHECK(sharp / 2 > 500);
}
