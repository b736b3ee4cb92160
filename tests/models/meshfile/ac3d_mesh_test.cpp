#include "models/meshfile/mesh_file.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;

namespace {

const std::string ac3d_start = "AC3Db\nMATERIAL \"light grey\" rgb 0.5 0.5 0.5 amb 0 0 0 emis 0 0 0 "
                               "spec 0 0 0 shi 10 trans 0\nMATERIAL red rgb 1 0 0\nOBJECT world\n";
const std::string ac3d_corners = "numvert 3\n0 0 0\n1 0 0\n0 1 0\n";
const std::string surface = "numsurf 1\nSURF 0x10\nmat 1\nrefs 3\n0 0 0\n1 1 0\n2 0 1\n";

std::string refused_ac3d(const std::string& text) { return error_of("part.ac", text); }

} // namespace

TEST_CASE("objects of AC3D stand where their parents and they themselves put them") {
    const TriangleMesh mesh = read_mesh(file_with("part.ac",
        ac3d_start + "kids 1\nOBJECT group\nloc 10 0 0\nrot 0 -1 0 1 0 0 0 0 1\nkids 2\n" +
            "OBJECT poly\nname \"kids 3\"\ndata 6\nkids 9\ntexture \"a b.png\"\ntexrep 1 1\n" +
            "crease 45.0\nshowname 1\nloc 0 0 2\n" + ac3d_corners + surface + "kids 0\nOBJECT poly\n" + ac3d_corners +
            "numsurf 3\nSURF 0x30\nmat 0\nrefs 3\n2 0 0\n1 0 0\n0 0 0\nSURF 0x2\nmat 0\nrefs 2\n"
            "0 0 0\n1 0 0\nSURF 0x0\nmat 1\nrefs 1\n0 0 0\nkids 0\n"));
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {5, 4, 3}});
    CHECK(mesh.vertices_m[1] == glm::dvec3(10.0, 1.0, 2.0)); // x is turned to y
    CHECK(mesh.vertices_m[2] == glm::dvec3(9.0, 0.0, 2.0));
    CHECK(mesh.vertices_m[4] == glm::dvec3(10.0, 1.0, 0.0));
    REQUIRE(mesh.materials.size() == 2);
    CHECK(mesh.materials[0].name == "red");
    CHECK(mesh.materials[1].name == "light grey");
    CHECK(mesh.triangle_materials == std::vector<std::uint32_t>{0, 1});
    REQUIRE(mesh.notes.size() == 2);
    CHECK_THAT(mesh.notes[0], Catch::Contains("2 lines and other surfaces"));
    CHECK_THAT(mesh.notes[1], Catch::Contains("1 two-sided surfaces"));
}

TEST_CASE("materials of AC3D version c are blocks") {
    const TriangleMesh mesh = read_mesh(
        file_with("part.ac", "AC3Dc\nMAT \"x\"\nrgb 0 1 0\nshi 4\nENDMAT\nMAT \"y\"\nrgb 0 0 1\nENDMAT\nOBJECT poly\n" +
                                 ac3d_corners + surface + "kids 0\n"));
    CHECK(mesh.materials.at(0).colour == glm::vec3(0.0F, 0.0F, 1.0F));
}

TEST_CASE("an AC3D file that ends before all objects it announces is read, and that is said") {
    const TriangleMesh mesh =
        read_mesh(file_with("part.ac", ac3d_start + "kids 3\nOBJECT poly\n" + ac3d_corners + surface + "kids 0\n"));
    CHECK_FALSE(mesh.triangles.empty());
    REQUIRE(mesh.notes.size() == 1);
    CHECK_THAT(mesh.notes[0], Catch::Contains("ends 2 objects before"));
}

TEST_CASE("a faulty AC3D file is refused in one line that says where") {
    CHECK(refused_ac3d("AC2D\n") == "part.ac:1: expected AC3D, got 'AC2D'");
    CHECK(refused_ac3d("AC3Db\nMATERIAL \"a\" rgb 1 2 3\nOBJECT world\nkids 0\n") ==
          "part.ac:2: expected a part of a colour of 0 to 1, got '2'");
    CHECK(refused_ac3d(ac3d_start + "kids 1\n") == "part.ac:6: expected OBJECT, got the end of the file");
    CHECK(refused_ac3d(ac3d_start + "numvert 2147483647\n0 0 0\n") ==
          "part.ac:5: expected at most 1 vertices in a file of this size, got 2147483647");
    CHECK(refused_ac3d(ac3d_start + "numvert 1\n0 0 inf\n") == "part.ac:6: expected a coordinate, got 'inf'");
    CHECK(refused_ac3d(ac3d_start + ac3d_corners + "numsurf 1\nSURF 0x0\nmat 0\nrefs 3\n0 0 0\n1 0 0\n3 0 0\n") ==
          "part.ac:15: expected a vertex of 0 to 2, got '3'");
    CHECK(refused_ac3d(ac3d_start + ac3d_corners + "numsurf 1\nSURF 0x0\nmat 2\n") ==
          "part.ac:11: expected a material of 0 to 1, got '2'");
    CHECK(refused_ac3d(ac3d_start + "hello\n") == "part.ac:5: expected a line of an object, got 'hello'");
    std::string deep = ac3d_start;
    for (int i = 0; i < 200; ++i) { deep += "kids 1\nOBJECT group\n"; }
    CHECK(refused_ac3d(deep) == "part.ac:206: expected objects at most 100 deep, got a deeper one");
}
