#include "models/simplify/collapse_guard.h"
#include "models/simplify/simplify.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>

#include <array>

using namespace octant;
using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

/// Balls side by side, each half as large as the one before.
TriangleMesh balls(int count) {
    TriangleMesh mesh;
    double scale = 1.0;
    for (int i = 0; i < count; ++i, scale *= 0.5) {
        const TriangleMesh one = ball(8);
        const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
        for (const glm::dvec3& vertex_m : one.vertices_m) {
            mesh.vertices_m.push_back(scale * vertex_m + glm::dvec3(4.0 * i, 0.0, 0.0));
        }
        for (const auto& [a, b, c] : one.triangles) {
            mesh.triangles.push_back({a + first, b + first, c + first});
        }
    }
    return mesh;
}

} // namespace

TEST_CASE("a goal that all shells cannot reach drops the smallest ones, unless they are kept") {
    SimplifyOptions options;
    options.goal.faces = 12;
    const Simplified fewer = simplified(balls(4), options);
    CHECK(fewer.mesh.triangles.size() <= 12);
    CHECK(fewer.shells_gone == 2);
    CHECK(euler_number(fewer.mesh) == 4); // two closed shells are left
    options.keep_shells = true;
    options.quality = Quality::Fast;
    const Simplified all = simplified(balls(4), options);
    CHECK(all.shells_gone == 0);
    CHECK(all.mesh.triangles.size() == 16);
    options.keep_shells = false;
    options.goal.faces = 200;
    CHECK(simplified(balls(4), options).shells_gone == 0);
}

TEST_CASE("only triangles lower than what is negligible may turn over") {
    const std::array<glm::dvec3, 3> low{
        glm::dvec3(0.0, 0.0, 0.0), glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.5, 0.01, 0.0)};
    const std::array<glm::dvec3, 3> turned{low[0], low[2], low[1]};
    CHECK_FALSE(may_become(low, turned, Strictness::Normal));
    CHECK_FALSE(may_become(low, turned, Strictness::Normal, 0.005));
    CHECK(may_become(low, turned, Strictness::Normal, 0.02));
}
