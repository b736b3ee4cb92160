#include "models/meshfile/mesh_file.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>

using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;

namespace {

TriangleMesh read_off(const std::string& text) { return read_mesh(file_with("part.off", text)); }

std::string refused_off(const std::string& text) { return error_of("part.off", text); }

} // namespace

TEST_CASE("an OFF file is read in double precision, its polygons one-sided") {
    const TriangleMesh mesh =
        read_off("# a square\nOFF # counts\n4 1 4\n\n500000.123456789 0 0\n1 0 0 # a corner\n1 1 0\n0 1 0\n"
                 "4  0 1 2 3\n");
    CHECK(mesh.vertices_m[0].x == 500000.123456789);
    CHECK(mesh.vertices_m.size() == 4);
    CHECK(mesh.triangles.size() == 2);
    CHECK(mesh.colours.empty());
    CHECK(mesh.materials.empty());
    CHECK(mesh.notes.empty());
}

TEST_CASE("the header of an OFF file may be missing or run into the counts") {
    const std::string body = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    CHECK(read_off(body).triangles.size() == 1);
    CHECK(read_off("OFF" + body).triangles.size() == 1);
    CHECK(read_off("OFF " + body).triangles.size() == 1);
}

TEST_CASE("OFF files give vertices normals, colours and texture coordinates, and faces colours") {
    const TriangleMesh mesh =
        read_off("STCNOFF\n3 1 0\n0 0 0  0 0 2  255 0 0 255  0.25 0.5\n1 0 0  0 0 1  0 255 0 255  1 0\n"
                 "0 1 0  0 0 1  0.0 0.0 1.0 1.0  0 1\n3 0 1 2  0.5 0.25 1.0\n");
    REQUIRE(mesh.colours.size() == 3);
    CHECK(mesh.colours[0] == glm::vec3(1.0F, 0.0F, 0.0F));
    CHECK(mesh.colours[2] == glm::vec3(0.0F, 0.0F, 1.0F));
    REQUIRE(mesh.corner_normals.size() == 1);
    CHECK(mesh.normals[mesh.corner_normals[0][0]] == glm::vec3(0.0F, 0.0F, 1.0F));
    REQUIRE(mesh.corner_texture_coordinates.size() == 1);
    CHECK(mesh.texture_coordinates[mesh.corner_texture_coordinates[0][0]] == glm::vec2(0.25F, 0.5F));
    REQUIRE(mesh.materials.size() == 1);
    CHECK(mesh.materials[0].colour == glm::vec3(0.5F, 0.25F, 1.0F));
    CHECK(read_off("OFF\n3 1 0\n0 0 0 255 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n").colours[0] ==
          glm::vec3(1.0F, 0.0F, 0.0F));
}

TEST_CASE("what an OFF file has that is not read is noted once") {
    const TriangleMesh mesh = read_off("OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n2 0 1\n1 2\n");
    CHECK(mesh.triangles.size() == 1);
    REQUIRE(mesh.notes.size() == 2);
    CHECK_THAT(mesh.notes[0], Catch::EndsWith("faces of fewer than 3 corners are not read: 2"));
    CHECK_THAT(mesh.notes[1], Catch::EndsWith("numbers of a colour map are not read"));
}

TEST_CASE("a faulty OFF file is refused in one line that says where") {
    CHECK(refused_off("# x\n4OFF\n") == "part.off:2: expected OFF, COFF, NOFF, STOFF or a mixture "
                                        "of them, as text and in three dimensions, got '4OFF'");
    CHECK_THAT(refused_off("OFF BINARY\n"), Catch::StartsWith("part.off:1: expected OFF, "));
    CHECK_THAT(refused_off("OFF\n99999 1 0\n0 0 0\n"),
        Catch::StartsWith("part.off:2: expected the number of vertices of 0 to "));
    CHECK(refused_off("OFF\n3 1 0\n0 0 0\n1 x 0\n") == "part.off:4: expected a coordinate, got 'x'");
    CHECK(refused_off("OFF\n3 1 0\n0 0 0\n1 0 0 1\n") == "part.off:4: expected a colour of 3 or 4 numbers, got '1'");
    CHECK(refused_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n") ==
          "part.off:6: expected the number of a vertex of 0 to 2, got '3'");
    CHECK(refused_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 256 0 0\n") ==
          "part.off:6: expected parts of a colour of 0 to 255, got '256 0 0'");
    CHECK(refused_off("OFF\n0 0 0\n") == "part.off: expected at least one triangle, got none");
}
