#include "models/meshfile/mesh_file.h"
#include "models/meshfile/repair.h"
#include "tests/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>

using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;

TEST_CASE("the scanned bunny is read and mended as published") {
    const auto path = real_mesh_file("bun_zipper.ply");
    if (!path) {
        return;
    }
    const TriangleMesh mesh = read_mesh(*path);
    CHECK(mesh.vertices_m.size() == 35947);
    CHECK(mesh.triangles.size() == 69451);
    CHECK(mesh.vertices_m[0] == glm::dvec3(-0.0378297, 0.12794, 0.00447467));
    const RepairedMesh after = repaired(mesh);
    CHECK(
        after.counts ==
        RepairCounts{.unreferenced_vertices = 1113, .boundary_loops = 5, .shells = 1});
    CHECK(after.mesh.triangles.size() == 69451);
    CHECK(manifold_fault(after.mesh).empty());
}

TEST_CASE("the cow has one vertex where two fans meet") {
    const auto path = real_mesh_file("cow.obj");
    if (!path) {
        return;
    }
    const TriangleMesh mesh = read_mesh(*path);
    const RepairedMesh after = repaired(mesh);
    CHECK(after.counts.split_vertices == 1);
    CHECK(after.counts.split_edges == 0);
    CHECK(after.counts.boundary_loops == 0);
    CHECK(after.mesh.triangles.size() == mesh.triangles.size());
    CHECK(manifold_fault(after.mesh).empty());
}

TEST_CASE("the spotted cow is a clean closed mesh") {
    const auto path = real_mesh_file("spot.obj");
    if (!path) {
        return;
    }
    const RepairedMesh after = repaired(read_mesh(*path));
    CHECK(after.counts == RepairCounts{.shells = 1});
    CHECK(manifold_fault(after.mesh).empty());
}
