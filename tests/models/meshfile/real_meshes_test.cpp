#include "models/meshfile/mesh_file.h"
#include "models/repair/repair.h"
#include "tests/models/meshfile/mesh_samples.h"
#include "tests/real_files.h"

#include <catch2/catch.hpp>

#include <string>

using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::repair;
using namespace octant::models::meshfile::test;
using namespace octant::tests;

TEST_CASE("the scanned bunny is read and mended as published") {
    const auto path = octant::tests::real_file("meshes/bun_zipper.ply");
    if (!path) { return; }
    const TriangleMesh mesh = read_mesh(*path);
    CHECK(mesh.vertices_m.size() == 35947);
    CHECK(mesh.triangles.size() == 69451);
    CHECK(mesh.vertices_m[0] == glm::dvec3(-0.0378297, 0.12794, 0.00447467));
    const RepairedMesh after = repaired(mesh);
    CHECK(after.counts == RepairCounts{.unreferenced_vertices = 1113, .boundary_loops = 5, .shells = 1});
    CHECK(after.mesh.triangles.size() == 69451);
    CHECK(manifold_fault(after.mesh).empty());
}

TEST_CASE("the bunny goes through every format") {
    const auto path = octant::tests::real_file("meshes/bun_zipper.ply");
    if (!path) { return; }
    const TriangleMesh mesh = read_mesh(*path);
    for (const std::string ending : {".obj", ".ply", ".ac", ".wrl", ".gltf", ".glb"}) {
        INFO(ending);
        const bool holds_float = ending.starts_with(".gl");
        const std::filesystem::path copy = scratch_file("bunny" + ending);
        write_mesh(copy, mesh);
        const TriangleMesh after = read_mesh(copy);
        REQUIRE(after.vertices_m.size() == mesh.vertices_m.size());
        std::size_t moved = 0;
        for (std::size_t v = 0; v < mesh.vertices_m.size(); ++v) {
            const glm::dvec3& was_m = mesh.vertices_m[v];
            const glm::dvec3 held_m = holds_float ? glm::dvec3(glm::vec3(was_m)) : was_m;
            moved += static_cast<std::size_t>(after.vertices_m[v] != held_m);
        }
        CHECK(moved == 0);
        CHECK((after.triangles == mesh.triangles));
    }
    const std::filesystem::path copy = scratch_file("bunny.stl");
    write_mesh(copy, mesh);
    const TriangleMesh after = read_mesh(copy);
    CHECK(after.vertices_m.size() == 35947 - 1113);
    CHECK(repaired(after).counts == RepairCounts{.boundary_loops = 5, .shells = 1});
}

TEST_CASE("the cow has one vertex where two fans meet") {
    const auto path = octant::tests::real_file("meshes/cow.obj");
    if (!path) { return; }
    const TriangleMesh mesh = read_mesh(*path);
    const RepairedMesh after = repaired(mesh);
    CHECK(after.counts.split_vertices == 1);
    CHECK(after.counts.split_edges == 0);
    CHECK(after.counts.boundary_loops == 0);
    CHECK(after.mesh.triangles.size() == mesh.triangles.size());
    CHECK(manifold_fault(after.mesh).empty());
}

TEST_CASE("the spotted cow is a clean closed mesh") {
    const auto path = octant::tests::real_file("meshes/spot.obj");
    if (!path) { return; }
    const RepairedMesh after = repaired(read_mesh(*path));
    CHECK(after.counts == RepairCounts{.shells = 1});
    CHECK(manifold_fault(after.mesh).empty());
}
