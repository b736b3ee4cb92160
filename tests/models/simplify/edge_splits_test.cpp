#include "models/measure/triangle_bvh.h"
#include "models/simplify/edge_splits.h"
#include "models/simplify/point_lists.h"
#include "models/simplify/polish_target.h"
#include "models/simplify/target_mesh.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <vector>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

/// Two triangles of a unit square; the diagonal is the longest edge of both.
TriangleMesh square() {
    TriangleMesh mesh;
    mesh.vertices_m = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
    mesh.colours = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.materials.resize(2);
    mesh.triangle_materials = {0, 1};
    return mesh;
}

} // namespace

TEST_CASE("the longest edge of the neediest triangle is split in the middle, on both sides") {
    const std::vector<double> needs = {1.0, 2.0};
    const TriangleMesh split = with_split_edges(square(), needs, 5);
    REQUIRE(split.vertices_m.size() == 5);
    REQUIRE(split.triangles.size() == 4);
    CHECK(split.vertices_m[4] == glm::dvec3(0.5, 0.5, 0.0));
    CHECK(split.colours[4] == glm::vec3(0.5F, 0.5F, 0.0F));
    CHECK(std::ranges::count(split.triangle_materials, 0U) == 2);
    CHECK(area_m2(split) == Approx(1.0));
    CHECK(std::ranges::all_of(split.triangles, [&](const Triangle& triangle) {
        return area_vector(split, triangle).z == Approx(0.5);
    }));
}

TEST_CASE("triangles without a need are not split") {
    const std::vector<double> none_needed = {0.0, 0.0};
    CHECK(with_split_edges(square(), none_needed, 5).triangles.size() == 2);
}

TEST_CASE("a split ball is closed and has as many vertices more as edges were split") {
    const TriangleMesh mesh = ball(8);
    const std::vector<double> needs(mesh.triangles.size(), 1.0);
    const TriangleMesh split = with_split_edges(mesh, needs, 7);
    CHECK(split.vertices_m.size() == mesh.vertices_m.size() + 7);
    CHECK(split.triangles.size() == mesh.triangles.size() + 14);
    CHECK(is_manifold(split));
    CHECK(boundary_edges(split) == 0);
    CHECK(euler_number(split) == 2);
}

TEST_CASE("the triangle that a dent is farthest from needs a vertex most") {
    TriangleMesh dented = ball(8);
    const TriangleMesh smooth = dented;
    const std::uint32_t corner = dented.triangles[20][0];
    dented.vertices_m[corner] *= 0.7;
    const WorkingUnits units = WorkingUnits::of(dented, 0.1);
    const TargetMesh target(dented, units);
    const octant::models::measure::TriangleBvh tree(target.places, target.triangles);
    const WorkingSurface surface(smooth, units);
    for (const SplitBy by : {SplitBy::Peaks, SplitBy::Squares}) {
        TrackedPoints points = points_on(surface, target, 2'000);
        const std::vector<double> needs = split_needs(surface, points, {target, tree}, by);
        const auto most = static_cast<std::size_t>(std::ranges::max_element(needs) - needs.begin());
        CHECK(std::ranges::count(smooth.triangles[most], corner) == 1);
    }
}
