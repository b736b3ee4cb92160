#include "models/polygons/polygon_model.h"
#include "models/procedural/procedural_models.h"
#include "sim/base/random_generator.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

using namespace octant::models;
using namespace octant::models::procedural;
using namespace octant::models::polygons;

namespace {

constexpr double inner_radius_m = 13'880.0; ///< inside the sides of the 24-gon

glm::dvec3 point_inside(octant::RandomGenerator& dice, double min_height_m, double max_height_m) {
    while (true) {
        const double x = dice.between(-inner_radius_m, inner_radius_m);
        const double y = dice.between(-inner_radius_m, inner_radius_m);
        if (std::hypot(x, y) < inner_radius_m) { return {x, y, -dice.between(min_height_m, max_height_m)}; }
    }
}

/// Distance along the ray at which it meets the front of a polygon.
std::optional<double> front_hit(
    const PolygonModel& model, std::size_t polygon, const glm::dvec3& eye, const glm::dvec3& ray) {
    const glm::dvec3 normal = normal_of(model, polygon);
    const auto corners = model.corners(polygon);
    const double slope = glm::dot(ray, normal);
    if (slope >= 0.0) { return std::nullopt; }
    const double at = glm::dot(model.vertices_m[corners[0]] - eye, normal) / slope;
    const glm::dvec3 hit = eye + ray * at;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3& from = model.vertices_m[corners[i]];
        const glm::dvec3& to = model.vertices_m[corners[(i + 1) % corners.size()]];
        if (glm::dot(glm::cross(to - from, hit - from), normal) < 0.0) { return std::nullopt; }
    }
    return at > 0.0 ? std::optional(at) : std::nullopt;
}

} // namespace

TEST_CASE("the background has 24 mountains and 36 pieces of ground, all convex and planar") {
    const PolygonModel model = background60();
    REQUIRE(model.polygons.size() == 60);
    CHECK(model.parts == std::vector<std::string>{"mountains", "ground"});
    for (std::size_t i = 0; i < 60; ++i) {
        CHECK(polygon_fault(model, i, 1e-3).value_or("none") == "none");
        CHECK(model.polygons[i].part == (i < 24 ? 0U : 1U));
        CHECK(model.polygons[i].material < model.materials.size());
    }
    CHECK(model.materials.size() == 15);
    CHECK(radius_m(model) == Approx(14'000.0).epsilon(0.01));
}

TEST_CASE("mountains stand on the ground, face inward and are 300 to 1,500 m high") {
    const PolygonModel model = background60();
    for (std::size_t i = 0; i < 24; ++i) {
        const glm::dvec3 normal = normal_of(model, i);
        CHECK(normal.z == Approx(0.0).margin(1e-12));
        double foot_m = 1e9;
        double top_m = 0.0;
        for (const std::uint32_t vertex : model.corners(i)) {
            const glm::dvec3& corner_m = model.vertices_m[vertex];
            CHECK(glm::dot(corner_m, normal) < -13'800.0);
            foot_m = std::min(foot_m, -corner_m.z);
            top_m = std::max(top_m, -corner_m.z);
        }
        CHECK(foot_m == 0.0);
        CHECK(top_m >= 300.0);
        CHECK(top_m <= 1500.0);
    }
}

TEST_CASE("the ground lies at height 0, faces up and covers every place once") {
    const PolygonModel model = background60();
    for (std::size_t i = 24; i < 60; ++i) {
        CHECK(glm::distance(normal_of(model, i), glm::dvec3(0, 0, -1)) < 1e-12);
        for (const std::uint32_t vertex : model.corners(i)) { CHECK(model.vertices_m[vertex].z == 0.0); }
    }
    octant::RandomGenerator dice(60);
    for (int sample = 0; sample < 5000; ++sample) {
        const glm::dvec3 above = point_inside(dice, 1.0, 1.0);
        int covered = 0;
        for (std::size_t i = 24; i < 60; ++i) { covered += front_hit(model, i, above, {0, 0, 1}) ? 1 : 0; }
        CHECK(covered == 1);
    }
}

TEST_CASE("the areas of the ground add up to the 24-gon") {
    const PolygonModel model = background60();
    double area_m2 = 0.0;
    for (std::size_t i = 24; i < 60; ++i) {
        const auto corners = model.corners(i);
        for (std::size_t j = 1; j + 1 < corners.size(); ++j) {
            const glm::dvec3& a = model.vertices_m[corners[0]];
            area_m2 +=
                0.5 * glm::length(glm::cross(model.vertices_m[corners[j]] - a, model.vertices_m[corners[j + 1]] - a));
        }
    }
    const double expected_m2 = 12.0 * 14'000.0 * 14'000.0 * std::sin(2.0 * std::acos(-1.0) / 24.0);
    CHECK(area_m2 == Approx(expected_m2).epsilon(1e-4)); // corners lie on whole metres
}

TEST_CASE("along no line of sight inside the ring do two polygons face the eye") {
    const PolygonModel model = background60();
    octant::RandomGenerator dice(60);
    int hits = 0;
    for (int sample = 0; sample < 5000; ++sample) {
        const glm::dvec3 eye = point_inside(dice, 0.5, 6000.0);
        const glm::dvec3 ray{dice.between(-1, 1), dice.between(-1, 1), dice.between(-0.2, 0.5)};
        int faced = 0;
        for (std::size_t i = 0; i < 60; ++i) { faced += front_hit(model, i, eye, ray) ? 1 : 0; }
        CHECK(faced <= 1);
        hits += faced;
        const glm::dvec3 ground = eye - ray * (eye.z / ray.z);
        if (ray.z > 0.0 && std::hypot(ground.x, ground.y) < inner_radius_m) { CHECK(faced == 1); }
    }
    CHECK(hits > 2000);
}

TEST_CASE("neighbours share all corners on their common sides") {
    const PolygonModel model = background60();
    for (std::size_t i = 0; i < 60; ++i) {
        const auto corners = model.corners(i);
        for (std::size_t j = 0; j < corners.size(); ++j) {
            const glm::dvec3& from = model.vertices_m[corners[j]];
            const glm::dvec3& to = model.vertices_m[corners[(j + 1) % corners.size()]];
            for (const glm::dvec3& vertex : model.vertices_m) {
                const double detour_m =
                    glm::distance(from, vertex) + glm::distance(vertex, to) - glm::distance(from, to);
                const bool is_end = vertex == from || vertex == to;
                CHECK((is_end || detour_m > 1e-6));
            }
        }
    }
}
