#include "models/measure/mesh_distance.h"
#include "models/simplify/local_error.h"
#include "models/simplify/simplify.h"
#include "models/simplify/surface_samples.h"
#include "models/simplify/working_surface.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

double rms_m(const TriangleMesh& a, const TriangleMesh& b) {
    return measure::distance(a, b, {.tightness = 1.05, .negligible_m = 1e-4, .samples = 20'000}).rms_m();
}

/// Two materials left and right of x = 1.
TriangleMesh two_grounds(TriangleMesh mesh) {
    mesh.materials = {{"grass", glm::vec3(0.2F)}, {"sand", glm::vec3(0.8F)}};
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto& v = mesh.vertices_m;
        mesh.triangle_materials.push_back((v[a].x + v[b].x + v[c].x) / 3.0 < 1.0 ? 0 : 1);
    }
    return mesh;
}

} // namespace

TEST_CASE("more effort never leads farther off than collapses alone") {
    for (const TriangleMesh& fine : {ball(40), ring(40, 24), machined_part(12)}) {
        SimplifyOptions options;
        options.goal.faces = 300;
        options.effort = 0;
        double last_m = rms_m(fine, simplified(fine, options).mesh);
        for (const int effort : {1, 4}) {
            options.effort = effort;
            const TriangleMesh made = simplified(fine, options).mesh;
            CHECK(made.triangles.size() <= 300);
            CHECK(is_manifold(made));
            CHECK(boundary_edges(made) == 0);
            const double now_m = rms_m(fine, made);
            CHECK(now_m <= last_m);
            last_m = now_m;
        }
    }
}

TEST_CASE("few samples of a dense mesh stand for its large triangles by area and for each shell") {
    const std::size_t ground = hills_with_boxes(0, 1.0).triangles.size();
    const auto sampled = [&](int boxes, double edge_m) {
        const TriangleMesh mesh = hills_with_boxes(boxes, edge_m);
        return SurfaceSamples(WorkingSurface(mesh, WorkingUnits{}), 500);
    };
    const SurfaceSamples one = sampled(1, 0.2);
    CHECK(one.size() <= 510);
    double box_m2 = 0.0;
    double all_m2 = 0.0;
    for (std::uint32_t sample = 0; sample < one.size(); ++sample) {
        const double weight = static_cast<double>(one[sample].weight);
        all_m2 += weight;
        box_m2 += one[sample].triangle >= ground ? weight : 0.0;
    }
    CHECK(box_m2 == Approx(0.24).epsilon(0.02));
    CHECK(all_m2 == Approx(area_m2(hills_with_boxes(1, 0.2))).epsilon(0.001));
    for (std::uint32_t triangle = 0; triangle < 12; ++triangle) {
        CHECK(one.count(static_cast<std::uint32_t>(ground) + triangle) >= 5); // 0.02 of 1.28 m2
    }
    const SurfaceSamples small = sampled(20, 0.001);
    for (std::uint32_t box = 0; box < 20; ++box) {
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < 12; ++i) {
            count += small.count(static_cast<std::uint32_t>(ground) + 12 * box + i);
        }
        CHECK(count >= 1);
    }
}

TEST_CASE("the present error of coloured triangles is what measuring them again gives") {
    TriangleMesh red = strip(4, 4);
    red.colours.assign(red.vertices_m.size(), {0.8F, 0.1F, 0.0F});
    TriangleMesh blue = red;
    blue.colours.assign(red.vertices_m.size(), {0.0F, 0.2F, 0.9F});
    const WorkingUnits units = WorkingUnits::of(red, 0.1);
    const WorkingSurface fine(red, units);
    const WorkingSurface surface(blue, units);
    const OriginalSurface original(fine, red, units);
    SurfaceSamples samples(fine, 500);
    std::vector<std::uint32_t> faces;
    for (std::uint32_t sample = 0; sample < samples.size(); ++sample) { faces.push_back(samples[sample].face); }
    samples.assign_all(faces, std::vector<float>(samples.size(), 0.0F), surface.mesh);
    LocalError local(surface, samples, original);
    local.measure_all_back();
    for (const double per_high2 : {0.0, 100.0}) {
        samples.set_penalty({per_high2});
        std::vector<RingFace> ring;
        std::vector<std::uint32_t> around;
        surface.mesh.ring_at(7, ring, around);
        local.gather(around);
        local.set_ring(ring, surface.places[7], surface.colours[7]);
        const double again = local.measured();
        CHECK(again > 0.0);
        CHECK(local.present() == Approx(again).epsilon(1e-4));
    }
}

TEST_CASE("the number of steps that was told repeats a result") {
    SimplifyOptions options;
    options.goal.faces = 200;
    const Simplified by_effort = simplified(ball(24), options);
    options.effort = 0;
    options.steps = by_effort.steps;
    CHECK(same_bytes(simplified(ball(24), options).mesh, by_effort.mesh));
    options.steps.reset();
    options.deadline = std::chrono::steady_clock::now();
    CHECK(simplified(ball(24), options).steps == 0);
}

TEST_CASE("vertices move along a border and across the surface, its ends across it alone") {
    const TriangleMesh sheet = two_grounds(strip(4, 8));
    const WorkingSurface surface(sheet, WorkingUnits::of(sheet, 0.1));
    const auto moved = [&](const glm::dvec3& place_m) {
        const auto found = std::ranges::find_if(
            sheet.vertices_m, [&](const glm::dvec3& v) { return glm::distance(v, place_m) < 1e-9; });
        REQUIRE(found != sheet.vertices_m.end());
        const auto vertex = static_cast<std::uint32_t>(found - sheet.vertices_m.begin());
        return surface.along_borders(vertex, {1.0, 2.0, 3.0});
    };
    const glm::dvec3 whole(1.0, 2.0, 3.0);
    CHECK(moved({0.5, 0.5, 0.0}) == whole);
    INFO("between two materials");
    CHECK(glm::distance(moved({1.0, 0.5, 0.0}), {0.0, 2.0, 3.0}) < 1e-12);
    CHECK(glm::distance(moved({1.0, 0.0, 0.0}), {0.0, 0.0, 3.0}) < 1e-12);
    INFO("at the boundary");
    CHECK(glm::distance(moved({0.5, 0.0, 0.0}), {1.0, 0.0, 3.0}) < 1e-12);
}

TEST_CASE("a split edge leaves a closed manifold with two triangles and one vertex more") {
    const TriangleMesh made = octahedron();
    std::vector<Triangle> triangles = made.triangles;
    CollapsibleMesh mesh(made.vertices_m.size(), triangles);
    mesh.collapse(0);
    REQUIRE(mesh.face_count() == 6);
    std::uint32_t vertex = 0;
    while (mesh.has_vertex(vertex)) { ++vertex; }
    std::array<std::uint32_t, 2> free{};
    std::size_t found = 0;
    HalfEdge edge = none;
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        if (mesh.has_face(face)) {
            edge = 3 * face;
        } else {
            free.at(found++) = face;
        }
    }
    mesh.split(edge, vertex, free);
    CHECK(mesh.face_count() == 8);
    CHECK(mesh.vertex_count() == 6);
    CHECK(mesh.target(edge) == vertex);
    TriangleMesh split = made;
    split.triangles.clear();
    std::size_t corners = 0;
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) { split.triangles.push_back(mesh.corners(face)); }
    for (std::uint32_t v = 0; v < 6; ++v) {
        mesh.around(v, [&](HalfEdge h) { corners += mesh.origin(h) == v ? 1U : 0U; });
    }
    CHECK(corners == 24);
    CHECK(is_manifold(split));
    CHECK(boundary_edges(split) == 0);
}

TEST_CASE("the way back keeps to the side of a thin part from which it starts") {
    TriangleMesh sheet; // two squares, the lower one seen from below
    sheet.vertices_m = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.1},
        {1.0, 0.0, 0.1}, {1.0, 1.0, 0.1}, {0.0, 1.0, 0.1}};
    sheet.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
    const WorkingSurface surface(sheet, WorkingUnits{});
    const OriginalSurface original(surface, sheet, WorkingUnits{});
    double distance2 = 0.0;
    const OriginalPoint upper = original.nearest_from(2, {0.25, 0.75, 0.02}, distance2);
    CHECK(upper.triangle == 3);
    CHECK(distance2 == Approx(0.08 * 0.08));
    const OriginalPoint lower = original.nearest_from(0, {0.25, 0.75, 0.02}, distance2);
    CHECK(lower.triangle == 1);
    CHECK(distance2 == Approx(0.02 * 0.02));
}

TEST_CASE("nearest points on triangles without area are numbers") {
    std::mt19937 random(5);
    const auto coordinate = [&random](double scale) { return scale * (static_cast<double>(random() % 5) - 2.0); };
    for (int i = 0; i < 20'000; ++i) {
        const double scale = std::pow(10.0, -static_cast<double>(random() % 150));
        TriangleMesh thin;
        for (int k = 0; k < 3; ++k) {
            thin.vertices_m.emplace_back(
                coordinate(scale), coordinate(i % 2 == 0 ? 0.0 : scale), coordinate(1e-9 * scale));
        }
        thin.triangles = {{0, 1, 2}};
        const OriginalSurface original(WorkingSurface(thin, WorkingUnits{}), thin, WorkingUnits{});
        const glm::dvec3 point(coordinate(scale), coordinate(0.5 * scale), coordinate(scale));
        double distance2 = -1.0;
        original.nearest_from(0, point, distance2);
        double corner2 = glm::distance(point, thin.vertices_m[0]);
        corner2 *= corner2;
        CHECK(distance2 >= 0.0);
        if (scale > 1e-70) { // Products of four lengths are numbers then.
            CHECK(distance2 <= corner2 + 1e-9 * scale * scale);
        }
    }
}
