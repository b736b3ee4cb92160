#include "models/simplify/simplify.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>

using namespace octant;
using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

void add_ball(TriangleMesh& mesh, double scale, double x_m) {
    const TriangleMesh one = ball(8);
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const glm::dvec3& vertex_m : one.vertices_m) {
        mesh.vertices_m.push_back(scale * vertex_m + glm::dvec3(x_m, 0.0, 0.0));
    }
    for (const auto& [a, b, c] : one.triangles) {
        mesh.triangles.push_back({a + first, b + first, c + first});
    }
}

/// Balls side by side, each half as large as the one before.
TriangleMesh balls(int count) {
    TriangleMesh mesh;
    double scale = 1.0;
    for (int i = 0; i < count; ++i, scale *= 0.5) {
        add_ball(mesh, scale, 4.0 * i);
    }
    return mesh;
}

} // namespace

TEST_CASE("a goal that all shells cannot reach drops the smallest ones, unless they are kept") {
    SimplifyOptions options;
    options.goal.faces = 12;
    const Simplified fewer = simplified(balls(4), options);
    CHECK(fewer.mesh.triangles.size() <= 12);
    CHECK(fewer.shells_gone == 1);
    CHECK(euler_number(fewer.mesh) == 6); // three closed shells are left
    options.keep_shells = true;
    const Simplified all = simplified(balls(4), options);
    CHECK(all.shells_gone == 0);
    CHECK(all.mesh.triangles.size() == 16);
    options.keep_shells = false;
    options.goal.faces = 200;
    CHECK(simplified(balls(4), options).shells_gone == 0);
}

TEST_CASE("of shells that must go those go that lie by others, small ones far off stay") {
    TriangleMesh mesh;
    add_ball(mesh, 1.0, 0.0);
    add_ball(mesh, 0.97, 0.0); // within the first
    add_ball(mesh, 0.3, 9.0);
    SimplifyOptions options;
    options.goal.faces = 10;
    const Simplified fewer = simplified(mesh, options);
    CHECK(fewer.shells_gone == 1);
    CHECK(std::ranges::any_of(
        fewer.mesh.vertices_m, [](const glm::dvec3& vertex_m) { return vertex_m.x > 8.0; }));
}

TEST_CASE("of very many shells that cannot collapse the goal's number stays, spread over all") {
    TriangleMesh mesh; // of 200 tetrahedra in a row, each a little smaller than the one before
    for (std::uint32_t i = 0; i < 200; ++i) {
        const double size_m = 1.0 - 0.002 * i;
        const glm::dvec3 at_m(4.0 * i, 0.0, 0.0);
        const std::uint32_t first = 4 * i;
        for (const glm::dvec3 corner :
             {glm::dvec3(0.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}) {
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
    CHECK(fewer.shells_gone >= 180);
    // The largest ones all stand on one side.
    CHECK(std::ranges::any_of(
        fewer.mesh.vertices_m, [](const glm::dvec3& vertex_m) { return vertex_m.x > 700.0; }));
}

TEST_CASE("for a wanted error shells go that lie nearer to others than that, unless they are kept") {
    TriangleMesh mesh;
    add_ball(mesh, 1.0, 0.0);
    add_ball(mesh, 0.97, 0.0); // within the first, 0.03 from it
    add_ball(mesh, 0.3, 9.0);
    SimplifyOptions options;
    options.goal.error_m = 0.12;
    const Simplified fewer = simplified(mesh, options);
    CHECK(fewer.shells_gone == 1);
    CHECK(euler_number(fewer.mesh) == 4);
    CHECK(fewer.steps > 0);
    options.goal.error_m = 0.02;
    CHECK(simplified(mesh, options).shells_gone == 0);
    options.goal.error_m = 0.12;
    options.keep_shells = true;
    CHECK(euler_number(simplified(mesh, options).mesh) == 6);
}
