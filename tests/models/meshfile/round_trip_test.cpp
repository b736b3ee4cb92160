#include "models/meshfile/mesh_file.h"
#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/mesh_join.h"
#include "models/repair/repair.h"
#include "models/triangle_mesh.h"
#include "sim/base/text_file.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <memory>

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
        // Without normals glTF is flat, and AC3D says of each surface how it is shaded.
        const bool says_shading = ending == ".gltf" || ending == ".glb" || ending == ".ac";
        CHECK(after.normals.empty() == !says_shading);
        CHECK(after.materials.empty());
    }
}

TEST_CASE("a cube comes back from STL with its vertices in the order of their first corners") {
    const TriangleMesh after = written_and_read(cube(), ".stl");
    CHECK(after.vertices_m.size() == 8);
    for (std::size_t t = 0; t < 12; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(after.vertices_m[after.triangles[t][k]] == cube().vertices_m[cube().triangles[t][k]]);
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

TEST_CASE("texture coordinates that break along an edge come back corner by corner") {
    TriangleMesh before = coloured_cube();
    for (int i = 0; i < 36; ++i) { // each corner has its own; parts of 1/64 are floats
        before.texture_coordinates.emplace_back(static_cast<float>(i) / 64.0F, 1.25F - static_cast<float>(i % 7));
    }
    for (std::uint32_t t = 0; t < 12; ++t) {
        before.corner_texture_coordinates.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    before.corner_texture_coordinates[5] = {invalid_index, invalid_index, invalid_index};
    for (const std::string ending : {".obj", ".ply", ".gltf", ".glb"}) {
        INFO(ending);
        const TriangleMesh after = written_and_read(before, ending);
        REQUIRE(after.corner_texture_coordinates.size() == 12);
        for (std::size_t t = 0; t < 12; ++t) {
            for (std::size_t k = 0; k < 3 && t != 5; ++k) {
                const std::uint32_t is = after.corner_texture_coordinates[t][k];
                REQUIRE(is != invalid_index);
                CHECK(after.texture_coordinates[is] ==
                      before.texture_coordinates[before.corner_texture_coordinates[t][k]]);
            }
        }
        // glTF has them for all vertices or for none.
        CHECK((after.corner_texture_coordinates[5][0] == invalid_index) == (ending[1] != 'g'));
        CHECK(repaired(after).mesh.corner_texture_coordinates.size() == 12);
    }
}

TEST_CASE("one pair of texture coordinates a vertex stands with the vertices of a PLY file") {
    TriangleMesh before = tetrahedron();
    before.texture_coordinates = {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}, {0.25F, 0.75F}};
    before.corner_texture_coordinates = before.triangles;
    const std::string bytes = ply_bytes(before);
    CHECK(bytes.find("property float s\nproperty float t\n") != bytes.npos);
    CHECK(bytes.find("texcoord") == bytes.npos);
    const TriangleMesh after = written_and_read(before, ".ply");
    CHECK(after.texture_coordinates == before.texture_coordinates);
    CHECK(after.corner_texture_coordinates == before.triangles);
}

TEST_CASE("a mesh far from the origin keeps its digits in glTF, by the translation of its node") {
    TriangleMesh before = tetrahedron();
    for (glm::dvec3& vertex_m : before.vertices_m) {
        vertex_m = glm::dvec3(500'000.0, 5'200'000.0, 300.0) + 100.0 / 3.0 * vertex_m;
    }
    const auto largest_move_m = [&](const std::string& ending) {
        const TriangleMesh after = written_and_read(before, ending);
        double largest_m = 0.0;
        for (std::size_t t = 0; t < 4; ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                largest_m = std::max(largest_m,
                    glm::distance(after.vertices_m[after.triangles[t][k]], before.vertices_m[before.triangles[t][k]]));
            }
        }
        CHECK(largest_m <= rounding_m("cube" + ending, bounds_of(before)));
        return largest_m;
    };
    CHECK(largest_move_m(".glb") < 1e-5); // half a step of a float at 64 m is 3.8e-6 m
    CHECK(largest_move_m(".gltf") < 1e-5);
    CHECK(largest_move_m(".stl") > 0.01); // half a step at 5,200,000 m is 0.25 m
    CHECK(rounding_m("cube.stl", bounds_of(before)) < 0.3);
    CHECK(largest_move_m(".ply") == 0.0);
    CHECK(rounding_m("cube.obj", bounds_of(before)) == 0.0);
    CHECK(gltf_text(cube()).find("translation") == std::string::npos);
}

TEST_CASE("what a format does not hold is told") {
    TriangleMesh mesh = coloured_cube();
    CHECK(write_warnings("a.obj", mesh).empty());
    CHECK(write_warnings("a.glb", mesh).empty());
    mesh.texture_coordinates = {{0.0F, 0.0F}};
    mesh.corner_texture_coordinates.assign(12, {0, 0, 0});
    CHECK(write_warnings("a.stl", mesh) ==
          std::vector<std::string>{"a.stl: the format holds no normals, colours of vertices, materials, texture "
                                   "coordinates; they are left out"});
    CHECK(write_warnings("a.wrl", mesh) ==
          std::vector<std::string>{"a.wrl: the format holds no texture coordinates; they are left out"});
    CHECK(write_warnings("a.stl", cube()).empty());
}

TEST_CASE("a picture inside a glTF file becomes a file beside an OBJ file, and goes back in") {
    TriangleMesh mesh = coloured_cube();
    const auto png = std::make_shared<const std::string>("\x89PNG\r\n\x1a\nno picture");
    mesh.materials[1].picture = "picture-0";
    mesh.materials[1].picture_bytes = png;
    mesh.texture_coordinates = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}};
    mesh.corner_texture_coordinates.assign(12, {0, 1, 2});
    const TriangleMesh inside = written_and_read(mesh, ".glb");
    REQUIRE(inside.materials.size() == 2);
    CHECK(inside.materials[0].picture.empty());
    REQUIRE(inside.materials[1].picture_bytes);
    CHECK(*inside.materials[1].picture_bytes == *png);
    const std::filesystem::path obj = scratch_file("beside.obj");
    write_mesh(obj, inside);
    CHECK(octant::read_file(obj.parent_path() / "beside-picture-0.png") == *png);
    const TriangleMesh beside = read_mesh(obj);
    REQUIRE(beside.materials.size() == 2);
    CHECK(std::filesystem::path(beside.materials[1].picture).filename() == "beside-picture-0.png");
    CHECK_FALSE(beside.materials[1].picture_bytes);
    const std::filesystem::path glb = scratch_file("again.glb");
    write_mesh(glb, beside);
    REQUIRE(read_mesh(glb).materials[1].picture_bytes);
    CHECK(*read_mesh(glb).materials[1].picture_bytes == *png);
}

TEST_CASE("parts of a joined mesh come out as they went in") {
    TriangleMesh joined;
    TriangleMesh one = coloured_cube();
    one.texture_coordinates = {{0.0F, 0.0F}, {0.5F, 1.0F}};
    one.corner_texture_coordinates.assign(12, {0, 1, 1});
    join_mesh(joined, coloured_cube(), {});
    join_mesh(joined, one, {});
    const TriangleMesh part = part_of_materials(joined, 2, 2);
    CHECK(part.vertices_m == one.vertices_m);
    CHECK(part.triangles == one.triangles);
    CHECK(part.colours == one.colours);
    CHECK(part.normals == one.normals);
    CHECK(part.corner_normals == one.corner_normals);
    CHECK(part.texture_coordinates == one.texture_coordinates);
    CHECK(part.corner_texture_coordinates == one.corner_texture_coordinates);
    CHECK(part.triangle_materials == one.triangle_materials);
    CHECK(part.materials.size() == 2);
}

TEST_CASE("a file that cannot be written says so and a wrong ending is refused") {
    CHECK_THROWS_WITH(write_mesh("/no/such/folder/a.ply", cube()), Catch::Contains("cannot be written"));
    CHECK_THROWS_WITH(write_mesh(scratch_file("a.step"), cube()), Catch::Contains("expected a mesh file"));
}
