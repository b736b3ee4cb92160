#include "models/meshfile/mesh_file.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>

#include <fmt/format.h>

using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;
using namespace octant::tests;

namespace {

TriangleMesh read_obj_text(std::string_view text) {
    TriangleMesh mesh = read_mesh(file_with("part.obj", text));
    CHECK(index_fault(mesh).empty());
    return mesh;
}

std::string refused(std::string_view text) { return error_of("part.obj", text); }

constexpr std::string_view three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

} // namespace

TEST_CASE("an OBJ triangle is read, and all that says nothing about triangles is passed over") {
    const TriangleMesh mesh =
        read_obj_text("\xef\xbb\xbf# a comment\no part\ng one two\ns off\nvt 0 0\nvp 1\nl 1 2\n"
                      "v 0 0 0\nv 1e0 0 0 1.0\nv 0 +1 0\nnonsense\n\n\r\r\n \t\r\r\nf 1/1 \\\n 2/1/ 3\n");
    CHECK(mesh.name == "part");
    CHECK(mesh.vertices_m == std::vector<glm::dvec3>{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
    CHECK(mesh.colours.empty());
    CHECK(mesh.normals == std::vector<glm::vec3>{{0.0F, 0.0F, 1.0F}}); // s off
    CHECK(mesh.materials.empty());
    CHECK(mesh.notes.empty());
}

TEST_CASE("OBJ corners count back from the last vertex where they are negative") {
    const TriangleMesh mesh = read_obj_text("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2 -1\n");
    CHECK(mesh.triangles == std::vector<Triangle>{{1, 2, 3}, {1, 3, 4}});
}

TEST_CASE("OBJ vertex colours are read; vertices without are white beside them") {
    const TriangleMesh mesh = read_obj_text("v 0 0 0 1 0 0.5\nv 1 0 0\nv 0 1 0 0 0 0\nv 5 5 5\nf 1 2 3");
    CHECK(mesh.colours ==
          std::vector<glm::vec3>{{1.0F, 0.0F, 0.5F}, {1.0F, 1.0F, 1.0F}, {0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F}});
}

TEST_CASE("OBJ normals are made unit vectors, and faulty or missing ones the triangle's own") {
    const TriangleMesh mesh =
        read_obj_text(std::string(three) + "vn 0 3 4\nvn 0 0 0\nf 1//1 2//2 3//-2\nf 3 2 1\nf 1//1 2 3\n");
    REQUIRE(mesh.corner_normals.size() == 3);
    const auto normal = [&](std::size_t t, std::size_t k) { return mesh.normals[mesh.corner_normals[t][k]]; };
    CHECK(normal(0, 0) == glm::vec3(0.0F, 0.6F, 0.8F));
    CHECK(normal(0, 1) == glm::vec3(0.0F, 0.0F, 1.0F));
    CHECK(normal(0, 2) == normal(0, 0));
    CHECK(normal(1, 1) == glm::vec3(0.0F, 0.0F, -1.0F));
    CHECK(normal(2, 0) == normal(0, 0));
}

TEST_CASE("OBJ materials come in the order of their first polygon, with colours of the MTL file") {
    file_with("two words.mtl", "newmtl red\nKd 1 0 0\nnewmtl light blue\nKd 0.5 0.5 1\n");
    const TriangleMesh mesh =
        read_obj_text(std::string(three) + "mtllib two words.mtl\nf 1 2 3\nusemtl light blue\nf 1 2 3\n"
                                           "usemtl red\nusemtl light blue\nf 3 2 1\nusemtl green\nf 1 2 3\n");
    REQUIRE(mesh.materials.size() == 3);
    CHECK(mesh.materials[0].name == "light blue");
    CHECK(mesh.materials[0].colour == glm::vec3(0.5F, 0.5F, 1.0F));
    CHECK(mesh.materials[1].name == "green");
    CHECK(mesh.materials[2].name == "default");
    CHECK(mesh.triangle_materials == std::vector<std::uint32_t>{2, 0, 0, 1});
}

TEST_CASE("what an MTL file calls clear is apart from the body of an OBJ file") {
    file_with("glass.mtl", "newmtl glass\nTr 0\nd 0.25\nnewmtl tinted\nTr 0.25\nnewmtl hull\nd 1\nnewmtl odd\nTr 1\n"
                           "newmtl worse\nd -halo 0.5\n");
    std::string text = std::string(three) + "mtllib glass.mtl\n";
    for (const std::string name : {"glass", "tinted", "hull", "odd", "worse"}) {
        text += "usemtl " + name + "\nf 1 2 3\n";
    }
    const auto file = file_with("glass.obj", text);
    CHECK(read_mesh(file).triangles.size() == 5);
    const MeshParts parts = read_parts(file, {});
    CHECK(parts.body.triangles.size() == 3);
    REQUIRE(parts.clear.triangles.size() == 2);
    const auto opacity = [&](std::size_t t) {
        return parts.clear.materials[parts.clear.triangle_materials[t]].opacity;
    };
    CHECK(opacity(0) == 0.25F);
    CHECK(opacity(1) == 0.75F);
    const auto about = std::ranges::count_if(parts.body.notes, [](const std::string& note) {
        return note.ends_with("glass.mtl:9: expected Tr below 1, or d, too, got 'Tr 1': not read");
    });
    CHECK(about == 1);
}

TEST_CASE("of many opaque materials that mirror, which those of meshes do not, one note tells") {
    file_with("mirrors.mtl", "newmtl a\nillum 5\nnewmtl b\nillum 7\nnewmtl c\nillum 2\nnewmtl pane\nd 0.5\nillum 5\n");
    const TriangleMesh mesh = read_obj_text(
        std::string(three) + "mtllib mirrors.mtl\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n"
                             "usemtl pane\nf 1 2 3\n");
    REQUIRE(mesh.notes.size() == 1);
    CHECK_THAT(mesh.notes[0],
        Catch::EndsWith("part.obj: opaque materials do not mirror on a mesh (illum 5 or 7): 2, the first is a"));
}

TEST_CASE("a missing MTL file is noted") {
    const TriangleMesh mesh = read_obj_text("mtllib none.mtl\n" + std::string(three) + "usemtl a\nf 1 2 3");
    REQUIRE(mesh.notes.size() == 1);
    CHECK_THAT(
        mesh.notes[0], Catch::EndsWith("part.obj:1: material file none.mtl is missing, its materials are drawn grey"));
    CHECK(mesh.materials.at(0).name == "a");
}

TEST_CASE("a faulty OBJ file is refused in one line that says where") {
    const std::string start(three);
    CHECK(refused("v 0 0\n") == "part.obj:1: expected three numbers, got 2");
    CHECK(refused("v 0 0 nan\n") == "part.obj:1: expected a number, got 'nan'");
    CHECK(refused("v 0 0 1e13\n") == "part.obj:1: expected a number within 1e+12, got '1e13'");
    CHECK(refused("v 0 0 0 2 0 0\n") == "part.obj:1: expected a vertex colour of three numbers 0..1, got '2'");
    CHECK(refused(start + "f 1 2\n") == "part.obj:4: expected a polygon of 3 to 10000 corners, got 2");
    CHECK(refused(start + "f 1 2 4\n") == "part.obj:4: expected a vertex 1 to 3 (or -3 to -1), got '4'");
    CHECK(refused(start + "f 0 2 3\n") == "part.obj:4: expected a vertex 1 to 3 (or -3 to -1), got '0'");
    CHECK(refused(start + "f 1 2 /\n") == "part.obj:4: expected a vertex 1 to 3 (or -3 to -1), got ''");
    CHECK(refused(start + "f 1//1 2 3\n") == "part.obj:4: expected a normal 1 to 0 (or -0 to -1), got '1'");
    CHECK(refused(start) == "part.obj: expected at least one triangle, got none");
    CHECK(refused(std::string("v\0", 2)) == "part.obj: expected text, got binary data");
    std::string many = start + "f";
    for (int i = 0; i < 10001; ++i) { many += " 1"; }
    CHECK(refused(many) == "part.obj:4: expected a polygon of 3 to 10000 corners, got 10001");
}

TEST_CASE("a mesh written as OBJ comes back the same") {
    const TriangleMesh before = coloured_cube();
    const std::filesystem::path path = scratch_file("cube.obj");
    write_mesh(path, before);
    check_same(read_mesh(path), before);
}

TEST_CASE("material names that a file cannot hold are made fit for it") {
    TriangleMesh mesh = tetrahedron();
    mesh.materials = {{.name = "a\nb"}, {.name = ""}, {.name = "a_b"}, {.name = "x"}};
    mesh.triangle_materials = {0, 1, 2, 3};
    const std::filesystem::path path = scratch_file("names.obj");
    write_mesh(path, mesh);
    const TriangleMesh after = read_mesh(path);
    REQUIRE(after.materials.size() == 4);
    CHECK(after.materials[0].name == "a_b");
    CHECK(after.materials[1].name == "material");
    CHECK(after.materials[2].name == "a_b_2");
    CHECK(after.triangle_materials == mesh.triangle_materials);
}

TEST_CASE("a file of an unknown kind is refused by its ending") {
    CHECK(is_mesh_file("a/b.OBJ"));
    CHECK(is_mesh_file("b.ply"));
    CHECK_FALSE(is_mesh_file("b.txt"));
    CHECK_FALSE(is_mesh_file("obj"));
    CHECK_THAT(error_of("part.txt", ""), Catch::StartsWith("part.txt: expected a mesh file (.obj"));
    CHECK_THAT(error_of("part", ""), Catch::EndsWith("got a name without an ending"));
}
