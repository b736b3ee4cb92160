#include "models/measure/mesh_defects.h"
#include "tests/models/measure/made_meshes.h"

#include <catch2/catch.hpp>

#include <utility>

using namespace octant;
using models::TriangleMesh;
using models::measure::defects;
using models::measure::MeshDefects;

namespace {

TriangleMesh tetrahedron() {
    TriangleMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return mesh;
}

/// n x n fields joined at opposite sides: closed, of genus 1. Where it lies in space does not matter.
TriangleMesh torus(std::uint32_t n) {
    TriangleMesh mesh = tests::plate(static_cast<int>(n) - 1);
    mesh.triangles.clear();
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const auto at = [&](std::uint32_t right, std::uint32_t up) { return (y + up) % n * n + (x + right) % n; };
            mesh.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
            mesh.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
        }
    }
    return mesh;
}

} // namespace

TEST_CASE("a closed mesh has no defects, one shell and genus 0") {
    for (const TriangleMesh& mesh : {tetrahedron(), tests::ball(9)}) {
        MeshDefects clean;
        clean.shells = 1;
        clean.euler_characteristic = 2;
        clean.genus = 0;
        CHECK(defects(mesh) == clean);
    }
}

TEST_CASE("a torus has one handle, two shells add theirs") {
    CHECK(defects(torus(5)).euler_characteristic == 0);
    CHECK(defects(torus(5)).genus == 1);
    TriangleMesh both = torus(4);
    for (const auto& [a, b, c] : tetrahedron().triangles) { both.triangles.push_back({a + 16, b + 16, c + 16}); }
    for (const glm::dvec3& vertex_m : tetrahedron().vertices_m) {
        both.vertices_m.push_back(vertex_m + glm::dvec3(5.0));
    }
    CHECK(defects(both).shells == 2);
    CHECK(defects(both).genus == 1);
}

TEST_CASE("a plate has one rim, with holes one more for each") {
    TriangleMesh mesh = tests::plate(5);
    CHECK(defects(mesh).boundary_edges == 20);
    CHECK(defects(mesh).boundary_loops == 1);
    CHECK(defects(mesh).euler_characteristic == 1);
    CHECK_FALSE(defects(mesh).genus.has_value());
    mesh.triangles.erase(mesh.triangles.begin() + 24); // in the middle
    mesh.triangles.erase(mesh.triangles.begin() + 16); // apart from it
    CHECK(defects(mesh).boundary_edges == 26);
    CHECK(defects(mesh).boundary_loops == 3);
}

TEST_CASE("rims that touch in a vertex are still two") {
    TriangleMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
    const MeshDefects found = defects(mesh);
    CHECK(found.boundary_loops == 2);
    CHECK(found.non_manifold_vertices == 1);
    CHECK(found.non_manifold_edges == 0);
    CHECK(found.shells == 2);
}

TEST_CASE("three triangles at an edge make it non-manifold") {
    TriangleMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    const MeshDefects found = defects(mesh);
    CHECK(found.non_manifold_edges == 1);
    CHECK(found.boundary_edges == 6);
    CHECK(found.turned_edges == 0);
    CHECK(found.shells == 1);
}

TEST_CASE("a triangle turned round disagrees with its neighbours") {
    TriangleMesh mesh = tetrahedron();
    std::swap(mesh.triangles[2][0], mesh.triangles[2][1]);
    CHECK(defects(mesh).turned_edges == 3);
    CHECK_FALSE(defects(mesh).genus.has_value());
}

TEST_CASE("faces that come again are counted either way round") {
    TriangleMesh mesh = tetrahedron();
    mesh.triangles.push_back({2, 1, 0}); // the same
    mesh.triangles.push_back({0, 1, 2}); // its back
    CHECK(defects(mesh).duplicate_faces == 2);
    CHECK(defects(mesh).non_manifold_edges == 3);
}

TEST_CASE("degenerate faces are counted; those that repeat a vertex join nothing") {
    TriangleMesh mesh = tetrahedron();
    mesh.vertices_m.emplace_back(0.5, 0.0, 0.0);
    mesh.vertices_m.emplace_back(9.0, 9.0, 9.0);
    mesh.triangles.push_back({0, 0, 1});
    CHECK(defects(mesh).degenerate_faces == 1);
    CHECK(defects(mesh).unreferenced_vertices == 2);
    CHECK(defects(mesh).genus == 0);
    mesh.triangles.push_back({0, 4, 1}); // flat
    CHECK(defects(mesh).degenerate_faces == 2);
    CHECK(defects(mesh).unreferenced_vertices == 1);
    CHECK(defects(mesh).boundary_edges == 2);
}

TEST_CASE("a mesh without triangles has nothing but unreferenced vertices") {
    TriangleMesh mesh;
    mesh.vertices_m.resize(3, glm::dvec3(0.0));
    MeshDefects expected;
    expected.unreferenced_vertices = 3;
    CHECK(defects(mesh) == expected);
}
