#include "models/meshfile/mesh_file.h"
#include "models/repair/repair.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::repair;
using namespace octant::models::meshfile::test;
using namespace octant::tests;

namespace {

TriangleMesh written_and_read(const TriangleMesh& mesh, const std::string& ending) {
    const std::filesystem::path path = scratch_file("cube" + ending);
    write_mesh(path, mesh);
    TriangleMesh after = read_mesh(path);
    CHECK(index_fault(after).empty());
    CHECK(after.name == "cube");
    CHECK(after.notes.empty());
    return after;
}

} // namespace

TEST_CASE("a closed cube comes back from every format with its vertices and triangles") {
    for (const std::string ending : {".obj", ".ply", ".gltf", ".glb", ".ac", ".wrl"}) {
        INFO(ending);
        const TriangleMesh after = written_and_read(cube(), ending);
        CHECK(after.vertices_m == cube().vertices_m);
        CHECK(after.triangles == cube().triangles);
        CHECK(after.colours.empty());
        CHECK(after.normals.empty());
        CHECK(after.materials.empty());
    }
}

TEST_CASE("a cube comes back from STL with its vertices in the order of their first corners") {
    const TriangleMesh after = written_and_read(cube(), ".stl");
    CHECK(after.vertices_m.size() == 8);
    for (std::size_t t = 0; t < 12; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(
                after.vertices_m[after.triangles[t][k]] ==
                cube().vertices_m[cube().triangles[t][k]]);
        }
    }
    CHECK(repaired(after).counts == RepairCounts{.shells = 1});
}

TEST_CASE("colours, normals and materials come back from the formats that hold them") {
    const TriangleMesh before = coloured_cube();
    for (const std::string ending : {".obj", ".gltf", ".glb", ".wrl"}) {
        INFO(ending);
        const float rounding = ending[1] == 'g' ? 2e-7F : 0.0F; // glTF has them linear in floats
        const TriangleMesh after = written_and_read(before, ending);
        REQUIRE(after.triangles.size() == 12);
        REQUIRE(after.colours.size() == after.vertices_m.size());
        REQUIRE(after.corner_normals.size() == 12);
        for (std::size_t t = 0; t < 12; ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t was = before.triangles[t][k];
                const std::uint32_t is = after.triangles[t][k];
                CHECK(after.vertices_m[is] == before.vertices_m[was]);
                CHECK(glm::distance(after.colours[is], before.colours[was]) <= rounding);
                CHECK(after.normals[after.corner_normals[t][k]] == before.normals[t / 2]);
            }
        }
        // glTF parts a vertex that has several normals; repairing puts it together again.
        CHECK(repaired(after).mesh.vertices_m.size() == 8);
        CHECK(repaired(after).counts.boundary_loops == 0);
    }
    for (const std::string ending : {".obj", ".gltf", ".glb", ".wrl", ".ac"}) {
        INFO(ending);
        const TriangleMesh after = written_and_read(before, ending);
        CHECK(after.triangle_materials == before.triangle_materials);
        REQUIRE(after.materials.size() == 2);
        CHECK(after.materials[0].colour == before.materials[0].colour);
        CHECK(after.materials[1].colour == before.materials[1].colour);
    }
}

TEST_CASE("places that are no floats come back bit for bit from the formats that hold doubles") {
    TriangleMesh before = tetrahedron();
    before.vertices_m[1] = {1.0 / 3.0, 1e-17, 123456.789012345};
    for (const std::string ending : {".obj", ".ply", ".ac", ".wrl"}) {
        INFO(ending);
        CHECK(written_and_read(before, ending).vertices_m == before.vertices_m);
    }
}

TEST_CASE("a file that cannot be written says so and a wrong ending is refused") {
    CHECK_THROWS_WITH(
        write_mesh("/no/such/folder/a.ply", cube()), Catch::Contains("cannot be written"));
    CHECK_THROWS_WITH(
        write_mesh(scratch_file("a.step"), cube()), Catch::Contains("expected a mesh file"));
}
