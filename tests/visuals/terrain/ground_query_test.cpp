#include "tests/visuals/terrain/ground_check.h"
#include "visuals/terrain/frustum.h"
#include "visuals/terrain/ground_query.h"
#include "visuals/terrain/mesh_measurement.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;
using octant::models::heights::HeightField;

namespace {

/// Least height of a line above the ground at many places along it.
double sampled_clearance_m(
    const GroundSamples& ground, const glm::dvec3& from_m, const glm::dvec3& to_m, double radius_m) {
    double min_m = std::numeric_limits<double>::infinity();
    constexpr int steps = 20000;
    const double length_m = glm::distance(glm::dvec2(from_m), glm::dvec2(to_m));
    for (int k = 0; k <= steps; ++k) {
        const double share = static_cast<double>(k) / steps;
        const glm::dvec3 at_m = glm::mix(from_m, to_m, share);
        if (const auto height_m = ground_height_m(ground, at_m.x, at_m.y)) {
            // Both ground and target sink: the line rises by the difference between its chord and the ground's curve.
            const double way_m = share * length_m;
            const double rise_m =
                curvature_drop_m(way_m * way_m, radius_m) - share * curvature_drop_m(length_m * length_m, radius_m);
            min_m = std::min(min_m, at_m.z + rise_m - *height_m);
        }
    }
    return min_m;
}

} // namespace

TEST_CASE("height between samples is bilinear, and nothing outside") {
    const HeightField field = rough_field(20, 31, 2);
    const GroundSamples ground(field);
    Numbers numbers(4);
    for (int k = 0; k < 200; ++k) {
        const double x_m = numbers.between(-11.0, 11.0);
        const double y_m = numbers.between(-17.0, 17.0);
        const auto own = ground_height_m(ground, x_m, y_m);
        const auto fields = field.height_at(x_m, y_m);
        REQUIRE(own.has_value() == fields.has_value());
        if (own) { CHECK(*own == Approx(*fields).margin(1e-9)); }
    }
}

TEST_CASE("a ridge hides what lies behind it, at the place where the line meets it") {
    const HeightField field = bump_field(9, 4, 4, 3.0F); // a pyramid in the middle
    const GroundSamples ground(field);
    const LineOfSight hidden = line_of_sight(ground, {-3.0, 0.0, 1.0}, {3.0, 0.0, 1.0}, 0.0);
    CHECK_FALSE(hidden.visible);
    REQUIRE(hidden.blocked_at_m);
    CHECK(hidden.blocked_at_m->x == Approx(-2.0 / 3.0));
    CHECK(hidden.blocked_at_m->z == Approx(1.0));
    CHECK(hidden.clearance_m == Approx(-2.0));
    CHECK(hidden.min_clearance_at_m.x == Approx(0.0).margin(1e-9));
    const LineOfSight over = line_of_sight(ground, {-3.0, 0.0, 4.0}, {3.0, 0.0, 4.0}, 0.0);
    CHECK(over.visible);
    CHECK(over.clearance_m == Approx(1.0));
    const LineOfSight past_wall = line_of_sight(ground, {-3.0, 2.0, 1.0}, {3.0, 2.0, 1.0}, 0.0);
    CHECK(past_wall.visible);
}

TEST_CASE("the curved earth rises between two points by the product of their distances over 2 R") {
    const HeightField field = level_field(101, 3);
    const GroundSamples ground(field);
    constexpr double radius_m = 1000.0;
    const LineOfSight line = line_of_sight(ground, {-50.0, 0.0, 2.0}, {50.0, 0.0, 2.0}, radius_m);
    CHECK(line.clearance_m == Approx(2.0 - 50.0 * 50.0 / (2.0 * radius_m)));
    CHECK(line.min_clearance_at_m.x == Approx(0.0).margin(1e-6));
    CHECK(line.visible);
    CHECK_FALSE(line_of_sight(ground, {-50.0, 0.0, 1.0}, {50.0, 0.0, 1.0}, radius_m).visible);
}

TEST_CASE("clearances agree with sampling, on flat and curved earths, from inside and outside") {
    const HeightField field = rough_field(40, 30, 9);
    const GroundSamples ground(field);
    Numbers numbers(17);
    int hidden = 0;
    for (int k = 0; k < 200; ++k) {
        const auto point = [&] {
            return glm::dvec3(numbers.between(-25.0, 25.0), numbers.between(-20.0, 20.0), numbers.between(0.0, 12.0));
        };
        const glm::dvec3 from_m = point();
        const glm::dvec3 to_m = point();
        const double radius_m = numbers.coin() ? 0.0 : 200.0;
        const LineOfSight line = line_of_sight(ground, from_m, to_m, radius_m);
        const double sampled_m = sampled_clearance_m(ground, from_m, to_m, radius_m);
        if (std::isinf(sampled_m)) { continue; }
        CHECK(line.clearance_m <= sampled_m + 1e-9);
        CHECK(line.clearance_m == Approx(sampled_m).margin(0.01));
        hidden += line.visible ? 0 : 1;
    }
    CHECK(hidden > 8);
}

TEST_CASE("a ray meets the ground where nothing before it hides that place") {
    const HeightField field = rough_field(40, 30, 9);
    const GroundSamples ground(field);
    Numbers numbers(23);
    int hits = 0;
    for (int k = 0; k < 200; ++k) {
        const glm::dvec3 from_m(numbers.between(-25.0, 25.0), numbers.between(-20.0, 20.0), 15.0);
        const glm::dvec3 direction = glm::normalize(
            glm::dvec3(numbers.between(-1.0, 1.0), numbers.between(-1.0, 1.0), numbers.between(-1.0, 0.2)));
        const auto hit_m = intersect_ground(ground, from_m, direction, 100.0, 0.0);
        if (!hit_m) {
            const glm::dvec3 end_m = from_m + direction * 100.0;
            CHECK(line_of_sight(ground, from_m, end_m, 0.0).visible);
            continue;
        }
        ++hits;
        const auto ground_m = ground_height_m(ground, hit_m->x, hit_m->y);
        REQUIRE(ground_m);
        CHECK(hit_m->z == Approx(*ground_m).margin(1e-9));
        if (glm::distance(*hit_m, from_m + direction * glm::distance(*hit_m, from_m)) < 1e-3) {
            CHECK(line_of_sight(ground, from_m, *hit_m - direction * 1e-4, 0.0).visible);
        }
    }
    CHECK(hits > 25);
}

TEST_CASE("a mesh of all samples is found at every place, with heights between its corners") {
    Ground ground(rough_field(37, 50, 3));
    MeshView view;
    view.eye_m = {1.5, -4.0, 60.0};
    const GroundMesh mesh = ground.mesher.mesh(view, {5.0, 2.0, FanKind::Partial});
    MeshSurface surface;
    surface.set_mesh(mesh, view.eye_m);
    for (const auto& vertex : mesh.vertices) {
        const glm::dvec3 at_m = view.eye_m + glm::dvec3(vertex.position_m);
        const auto height_m = surface.height_at(at_m.x, at_m.y);
        REQUIRE(height_m);
        CHECK(*height_m == Approx(at_m.z).margin(1e-4));
    }
    Numbers numbers(5);
    for (int k = 0; k < 500; ++k) {
        const double x_m = numbers.between(-17.9, 17.9);
        const double y_m = numbers.between(-24.4, 24.4);
        const auto triangle = surface.triangle_at(x_m, y_m);
        REQUIRE(triangle);
        const auto height_m = surface.height_at(x_m, y_m);
        const auto hit = surface.first_hit({x_m, y_m, 50.0}, {x_m, y_m, -50.0});
        REQUIRE(hit);
        CHECK(50.0 - 100.0 * *hit == Approx(*height_m).margin(1e-4));
    }
    CHECK_FALSE(surface.height_at(18.5, 0.0));
}
