#include "visuals/planning/aircraft_model.h"

#include <catch2/catch.hpp>

#include <array>
#include <set>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
namespace planning = octant::visuals::planning;
namespace scene = octant::visuals::scene;

namespace {

/// A square of two triangles that faces -z, folded along its diagonal by a bend of the last corner.
models::TriangleMesh folded_square(double bend_m) {
    models::TriangleMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, bend_m}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

std::set<std::uint32_t> first_corners(const scene::ModelBuffers& buffers) {
    std::set<std::uint32_t> firsts;
    for (std::size_t i = 0; i < buffers.indices.size(); i += 3) { firsts.insert(buffers.indices[i]); }
    return firsts;
}

} // namespace

TEST_CASE("the coarsest level within the error is drawn, and no change comes back at once") {
    const std::array errors_m{0.0, 0.1, 0.4, 1.6};
    CHECK(planning::select_level(errors_m, 0.05, -1) == 0);
    CHECK(planning::select_level(errors_m, 0.5, -1) == 2);
    CHECK(planning::select_level(errors_m, 100.0, -1) == 3);
    CHECK(planning::select_level(errors_m, 0.41, 1) == 1); // good enough, but not by a margin
    CHECK(planning::select_level(errors_m, 0.6, 1) == 2);
    CHECK(planning::select_level(errors_m, 0.41, 2) == 2);
    CHECK(planning::select_level(errors_m, 0.39, 2) == 1); // never worse than asked for
    CHECK(planning::select_level({errors_m.data(), 1}, 0.0, 0) == 0);
}

TEST_CASE("a level never changes to and fro while the distance trembles") {
    const std::array errors_m{0.0, 0.1, 0.4};
    int level = -1;
    int changes = 0;
    for (int frame = 0; frame < 1000; ++frame) {
        const double max_m = 0.4 + 0.02 * (frame % 2 == 0 ? 1.0 : -1.0);
        const int next = planning::select_level(errors_m, max_m, level);
        changes += static_cast<int>(next != level);
        level = next;
    }
    CHECK(changes <= 2);
}

TEST_CASE("smooth corners share a vertex, creased ones do not") {
    scene::ModelBuffers flat;
    const models::TriangleMesh plane = folded_square(0.0);
    const planning::MeshLevel level = planning::append_level(flat, {&plane, 0.25});
    CHECK(flat.vertices.size() == 4);
    CHECK(level.error_m == 0.25);
    CHECK(level.range.index_count == 6);
    CHECK(level.range.polygons == 2);
    CHECK(flat.has_depth_drawn_meshes);
    scene::ModelBuffers creased;
    const models::TriangleMesh fold = folded_square(3.0);
    planning::append_level(creased, {&fold, 0.0});
    CHECK(creased.vertices.size() == 6);
}

TEST_CASE("every triangle of a level begins with a vertex of its own, with its own face normal") {
    models::TriangleMesh fan; // eight triangles around one vertex: more than they have corners
    fan.vertices_m.push_back({0, 0, 0});
    for (int i = 0; i < 8; ++i) {
        const double angle = 0.785398163397448 * i;
        fan.vertices_m.push_back({std::cos(angle), std::sin(angle), 0.3});
    }
    for (std::uint32_t i = 0; i < 8; ++i) { fan.triangles.push_back({0, 1 + (i + 1) % 8, 1 + i}); }
    scene::ModelBuffers buffers;
    planning::append_level(buffers, {&fan, 0.0});
    CHECK(first_corners(buffers).size() == 8);
    for (std::size_t t = 0; t < 8; ++t) {
        const scene::ModelVertex& first = buffers.vertices[buffers.indices[3 * t]];
        CHECK(first.polygon == t);
        const glm::dvec3 a(first.position_m);
        const glm::dvec3 b(buffers.vertices[buffers.indices[3 * t + 1]].position_m);
        const glm::dvec3 c(buffers.vertices[buffers.indices[3 * t + 2]].position_m);
        const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
        CHECK(glm::distance(glm::dvec3(first.face_normal), normal) < 1e-6);
    }
}

TEST_CASE("a model's meshes lie behind its polygons, and both count for its size") {
    planning::AircraftModel model = convex_aircraft(box_model({1, 1, 1}));
    const auto polygon_indices = static_cast<std::uint32_t>(model.buffers.indices.size());
    models::TriangleMesh large = folded_square(0.0);
    for (glm::dvec3& vertex_m : large.vertices_m) { vertex_m *= 5.0; }
    const std::array<planning::MeshSource, 1> sources{{{&large, 0.0}}};
    planning::add_levels(model, sources, 0.5);
    CHECK(model.levels[0].range.first_index == polygon_indices);
    CHECK(model.errors_m == std::vector<double>{0.0, 0.5});
    CHECK(model.hull.max_m.x == 5.0);
    CHECK(model.hull.min_m.x == -1.0);
    CHECK(model.subject.radius_m == Approx(5.0 * std::sqrt(2.0)));
    CHECK(model.shaded_as(0).size() == 2);
    CHECK(model.shaded_as(1).size() == 6);
}
