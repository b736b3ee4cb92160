#include "models/procedural/machined_part.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <map>
#include <utility>

using namespace octant::models;
using namespace octant::models::procedural;

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
