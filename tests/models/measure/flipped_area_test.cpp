#include "models/measure/sampled_distance.h"
#include "tests/models/measure/made_meshes.h"

#include <catch2/catch.hpp>

#include <utility>

using namespace octant;
using models::TriangleMesh;
using models::measure::flipped_area_share;
using models::measure::FlippedAreaOptions;

namespace {

void turn(models::Triangle& triangle) { std::swap(triangle[0], triangle[1]); }

/// Two plates `thickness_m` apart that face away from each other.
TriangleMesh sheet(int n, double thickness_m) {
    TriangleMesh mesh = tests::plate(n, 1.0, thickness_m);
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    const TriangleMesh below = tests::plate(n);
    mesh.vertices_m.insert(mesh.vertices_m.end(), below.vertices_m.begin(), below.vertices_m.end());
    for (const auto& [a, b, c] : below.triangles) { mesh.triangles.push_back({first + b, first + a, first + c}); }
    return mesh;
}

} // namespace

TEST_CASE("nothing of a mesh is flipped against itself, all of it against its back") {
    TriangleMesh mesh = tests::ball(12);
    CHECK(flipped_area_share(mesh, mesh) == 0.0);
    TriangleMesh back = mesh;
    for (models::Triangle& triangle : back.triangles) { turn(triangle); }
    CHECK(flipped_area_share(back, mesh) == 1.0);
}

TEST_CASE("the share of flipped triangles is that of their area") {
    const TriangleMesh original = tests::plate(4);
    TriangleMesh mesh = tests::plate(4, 1.0, 0.01);
    for (std::size_t i = 0; i < 8; ++i) { // of 32
        turn(mesh.triangles[i * 4]);
    }
    CHECK(flipped_area_share(mesh, original) == Approx(0.25).margin(1e-3));
}

TEST_CASE("a thin sheet that lies nearer to the other side is not flipped") {
    const TriangleMesh original = sheet(4, 0.01);
    TriangleMesh mesh = sheet(2, 0.002); // its upper side is nearer to the lower side
    CHECK(flipped_area_share(mesh, original) > 0.4);
    FlippedAreaOptions options;
    options.reach_m = 0.009;
    CHECK(flipped_area_share(mesh, original, options) == 0.0);
    const TriangleMesh halfway = sheet(2, 0.0045); // twice the distance reaches the right side
    CHECK(flipped_area_share(halfway, original) == 0.0);
}

TEST_CASE("any number of threads finds the same share") {
    const TriangleMesh original = tests::ball(12);
    const TriangleMesh mesh = tests::shaken(tests::ball(20), 4, 0.1);
    FlippedAreaOptions options;
    const double share = flipped_area_share(mesh, original, options);
    CHECK(share > 0.0);
    CHECK(share < 0.5);
    options.threads = 4;
    CHECK(flipped_area_share(mesh, original, options) == share);
}
