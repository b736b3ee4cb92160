#include "models/measure/mesh_defects.h"
#include "models/measure/mesh_distance.h"
#include "models/simplify/simplify.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

using namespace octant;
using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

void add_part(TriangleMesh& mesh, const TriangleMesh& part, double x_m) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const glm::dvec3& vertex_m : part.vertices_m) {
        mesh.vertices_m.push_back(vertex_m + glm::dvec3(x_m, 0.0, 0.0));
    }
    for (const auto& [a, b, c] : part.triangles) { mesh.triangles.push_back({a + first, b + first, c + first}); }
}

void add_ball(TriangleMesh& mesh, double scale, double x_m) {
    TriangleMesh one = ball(8);
    for (glm::dvec3& vertex_m : one.vertices_m) { vertex_m *= scale; }
    add_part(mesh, one, x_m);
}

/// Balls side by side, each half as large as the one before.
TriangleMesh balls(int count) {
    TriangleMesh mesh;
    double scale = 1.0;
    for (int i = 0; i < count; ++i, scale *= 0.5) { add_ball(mesh, scale, 4.0 * i); }
    return mesh;
}

/// Takes a triangle away that shares no vertex with one taken before.
Triangle take_triangle(TriangleMesh& mesh, std::mt19937& random, std::set<std::uint32_t>& used) {
    while (true) {
        const auto place = static_cast<std::ptrdiff_t>(random() % mesh.triangles.size());
        const Triangle taken = mesh.triangles[static_cast<std::size_t>(place)];
        if (std::ranges::none_of(taken, [&](std::uint32_t v) { return used.contains(v); })) {
            used.insert(taken.begin(), taken.end());
            mesh.triangles.erase(mesh.triangles.begin() + place);
            return taken;
        }
    }
}

/// Parts with tubes between triangles, which are handles where they join a part with itself, and so many holes of three
/// edges.
TriangleMesh riddled(std::mt19937& random, std::size_t parts, std::size_t tubes, std::size_t holes) {
    TriangleMesh mesh;
    for (std::size_t part = 0; part < parts; ++part) {
        add_part(mesh, random() % 2 == 0 ? ball(12) : ring(14, 10), 1.5 * static_cast<double>(part));
    }
    std::set<std::uint32_t> used;
    for (std::size_t i = 0; i < tubes; ++i) {
        const auto [a, b, c] = take_triangle(mesh, random, used);
        const auto [d, e, f] = take_triangle(mesh, random, used);
        for (const Triangle side : {Triangle{a, b, f}, {a, f, d}, {b, c, e}, {b, e, f}, {c, a, d}, {c, d, e}}) {
            mesh.triangles.push_back(side);
        }
    }
    for (std::size_t i = 0; i < holes; ++i) { take_triangle(mesh, random, used); }
    return mesh;
}

} // namespace

TEST_CASE("a goal that all shells cannot reach drops the smallest ones, unless they are kept") {
    SimplifyOptions options;
    options.goal.faces = 12;
    const Simplified fewer = simplified(balls(4), options);
    CHECK(fewer.mesh.triangles.size() <= 12);
    CHECK(fewer.shells_removed == 1);
    CHECK(euler_number(fewer.mesh) == 6); // three closed shells are left
    INFO("the two largest ones alone, at the same number of triangles, are farther off");
    const TriangleMesh two = simplified(balls(2), options).mesh;
    REQUIRE(two.triangles.size() <= 12);
    const auto off = [](const TriangleMesh& mesh) {
        return measure::distance(balls(4), mesh, {.tightness = 1.1, .samples = 20'000});
    };
    CHECK(off(fewer.mesh).max_hausdorff_m() < off(two).min_hausdorff_m());
    CHECK(off(fewer.mesh).rms_m() < 0.5 * off(two).rms_m());
    options.keep_shells = true;
    const Simplified all = simplified(balls(4), options);
    CHECK(all.shells_removed == 0);
    CHECK(all.mesh.triangles.size() == 16);
    options.keep_shells = false;
    options.goal.faces = 200;
    CHECK(simplified(balls(4), options).shells_removed == 0);
}

TEST_CASE("of shells that must go those go that lie by others, small ones far off stay") {
    TriangleMesh mesh;
    add_ball(mesh, 1.0, 0.0);
    add_ball(mesh, 0.97, 0.0); // within the first
    add_ball(mesh, 0.3, 9.0);
    SimplifyOptions options;
    options.goal.faces = 10;
    const Simplified fewer = simplified(mesh, options);
    CHECK(fewer.shells_removed == 1);
    CHECK(std::ranges::any_of(fewer.mesh.vertices_m, [](const glm::dvec3& vertex_m) { return vertex_m.x > 8.0; }));
}

TEST_CASE("parts above a dense mesh do not vanish where another step costs less") {
    const TriangleMesh fine = hills_with_boxes(20, 0.03);
    SimplifyOptions options;
    options.goal.faces = 140;
    for (const int effort : {0, 4}) {
        options.effort = effort;
        const Simplified fewer = simplified(fine, options);
        CHECK(fewer.mesh.triangles.size() <= 140);
        CHECK(fewer.shells_removed == 0);
        CHECK(measure::distance(fine, fewer.mesh, {.samples = 0}).max_hausdorff_m() < 0.1);
    }
}

TEST_CASE("a part that is far from all others does not vanish, whatever the goal") {
    TriangleMesh mesh;
    add_part(mesh, cube(1), 0.0);
    add_part(mesh, cube(1), 100.0);
    SimplifyOptions options;
    options.goal.faces = 4;
    const Simplified fewer = simplified(mesh, options);
    CHECK(fewer.shells_removed == 0);
    CHECK(fewer.mesh.triangles.size() == 8);
}

TEST_CASE("of very many shells that cannot collapse the goal's number stays, spread over all") {
    TriangleMesh mesh; // of 200 tetrahedra in a row, each a little smaller than the one before
    for (std::uint32_t i = 0; i < 200; ++i) {
        const double size_m = 1.0 - 0.002 * i;
        const glm::dvec3 at_m(4.0 * i, 0.0, 0.0);
        const std::uint32_t first = 4 * i;
        for (const glm::dvec3 corner : {glm::dvec3(0.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}) {
            mesh.vertices_m.push_back(at_m + size_m * corner);
        }
        for (const auto& [a, b, c] : {Triangle{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
            mesh.triangles.push_back({first + a, first + b, first + c});
        }
    }
    SimplifyOptions options;
    options.goal.faces = 80;
    const Simplified fewer = simplified(mesh, options);
    CHECK(fewer.mesh.triangles.size() <= 80);
    CHECK(fewer.shells_removed >= 180);
    // The largest ones all stand on one side.
    CHECK(std::ranges::any_of(fewer.mesh.vertices_m, [](const glm::dvec3& vertex_m) { return vertex_m.x > 700.0; }));
}

TEST_CASE("pinholes close, and thin handles go, where a goal needs it; neither where they are kept") {
    std::mt19937 random(7);
    const TriangleMesh fine = riddled(random, 1, 2, 12);
    REQUIRE(measure::defects(fine).boundary_loops == 12);
    SimplifyOptions options;
    options.goal.faces = 24;
    const Simplified fewer = simplified(fine, options);
    CHECK(fewer.mesh.triangles.size() <= 24);
    CHECK(fewer.holes_closed + measure::defects(fewer.mesh).boundary_loops == 12);
    CHECK(fewer.holes_closed >= 10);
    CHECK(fewer.handles_cut >= 1);
    CHECK(fewer.sequence.collapses.empty());
    options.keep_topology = true;
    const Simplified same = simplified(fine, options);
    CHECK(same.holes_closed == 0);
    CHECK(same.handles_cut == 0);
    CHECK(measure::defects(same.mesh).boundary_loops == 12);
    CHECK(euler_number(same.mesh) == euler_number(fine));
}

TEST_CASE("an error keeps its bound where holes close, and closed holes stay in the record") {
    std::mt19937 random(3);
    const TriangleMesh fine = riddled(random, 1, 0, 20);
    SimplifyOptions options;
    options.goal.error_m = 0.15;
    const Simplified result = simplified(fine, options);
    CHECK(result.holes_closed > 0);
    CHECK(result.holes_closed + measure::defects(result.mesh).boundary_loops == 20);
    CHECK(measure::distance(fine, result.mesh, {}).max_hausdorff_m() <= 0.15);
}

TEST_CASE("meshes with random holes, handles and parts stay manifolds, and closed ones closed") {
    std::mt19937 random(11);
    for (int i = 0; i < 8; ++i) {
        const std::size_t holes = i % 2 == 0 ? 0 : 2 + random() % 8;
        const TriangleMesh fine = riddled(random, 1 + random() % 3, random() % 5, holes);
        SimplifyOptions options;
        options.goal.faces = 12 + random() % 200;
        options.effort = static_cast<int>(random() % 3);
        options.keep_shells = random() % 2 == 0;
        INFO("mesh " << i << " to " << *options.goal.faces << " faces, effort " << options.effort);
        const TriangleMesh made = simplified(fine, options).mesh;
        const measure::MeshDefects found = measure::defects(made);
        CHECK(found.non_manifold_edges == 0);
        CHECK(found.non_manifold_vertices == 0);
        CHECK(found.turned_edges == 0);
        CHECK(found.duplicate_faces == 0);
        CHECK(found.boundary_loops <= holes);
        std::set<std::array<double, 3>> places;
        for (const glm::dvec3& vertex_m : made.vertices_m) { places.insert({vertex_m.x, vertex_m.y, vertex_m.z}); }
        CHECK(places.size() == made.vertices_m.size()); // no sides touch where a handle was cut
        options.threads = 3;
        CHECK(same_bytes(simplified(fine, options).mesh, made));
    }
}

TEST_CASE("for a wanted error shells go that lie nearer to others than that, unless they are kept") {
    TriangleMesh mesh;
    add_ball(mesh, 1.0, 0.0);
    add_ball(mesh, 0.97, 0.0); // within the first, 0.03 from it
    add_ball(mesh, 0.3, 9.0);
    SimplifyOptions options;
    options.goal.error_m = 0.12;
    const Simplified fewer = simplified(mesh, options);
    CHECK(fewer.shells_removed == 1);
    CHECK(euler_number(fewer.mesh) == 4);
    CHECK(fewer.steps > 0);
    options.goal.error_m = 0.02;
    CHECK(simplified(mesh, options).shells_removed == 0);
    options.goal.error_m = 0.12;
    options.keep_shells = true;
    CHECK(euler_number(simplified(mesh, options).mesh) == 6);
}
