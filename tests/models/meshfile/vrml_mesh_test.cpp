#include "models/meshfile/mesh_file.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;
using namespace octant::tests;

namespace {

const std::string vrml_start = "#VRML V2.0 utf8\n";
const std::string points = "coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } ";

std::string shape(const std::string& fields) {
    return "Shape { geometry IndexedFaceSet { " + points + fields + " } }\n";
}

TriangleMesh read_vrml(const std::string& text) {
    TriangleMesh mesh = read_mesh(file_with("part.wrl", vrml_start + text));
    CHECK(index_fault(mesh).empty());
    return mesh;
}

std::string refused_vrml(const std::string& text) { return error_of("part.wrl", vrml_start + text); }

} // namespace

TEST_CASE("a VRML face set is found among nodes that are passed over") {
    const TriangleMesh mesh =
        read_vrml("WorldInfo { title \"a } \\\" [ {\" info [ \"x\", \"y\" ] }\n# } comment\n"
                  "PROTO Thing [ field SFFloat a 1 ] { Group { children [ ] } }\n"
                  "EXTERNPROTO Other [ ] [ \"urn:x\" ]\n"
                  "Script { url \"x\" eventIn SFTime t field SFNode n NULL directOutput TRUE }\n"
                  "Group { children [ Viewpoint { position 0 0 9 } DirectionalLight { } " +
                  shape("solid FALSE coordIndex [ 0 1 2 # a comment\n 3 -1, 2,1,0 ]") + "] }\nROUTE a.b TO c.d\n");
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {2, 1, 0}});
    CHECK(mesh.vertices_m.size() == 4);
    CHECK(mesh.materials.empty());
    REQUIRE(mesh.notes.size() == 1);
    CHECK_THAT(mesh.notes[0], Catch::Contains("prototypes are not read"));
}

TEST_CASE("VRML transforms place, turn, scale and mirror") {
    const TriangleMesh mesh =
        read_vrml("Transform { translation 10 0 0 rotation 0 0 1 1.5707963267948966 scale 2 1 1 children "
                  "DEF S " +
                  shape("coordIndex [ 0 1 2 ]") + "}\nTransform { scale -1 1 1 center 1 0 0 children [ USE S ] }");
    REQUIRE(mesh.vertices_m.size() == 8);
    CHECK(glm::distance(mesh.vertices_m[1], glm::dvec3(10.0, 2.0, 0.0)) < 1e-12);
    CHECK(glm::distance(mesh.vertices_m[3], glm::dvec3(9.0, 0.0, 0.0)) < 1e-12);
    CHECK(mesh.vertices_m[4] == glm::dvec3(2.0, 0.0, 0.0));
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {6, 5, 4}});
}

TEST_CASE("VRML colours of corners part a vertex, colours of faces are materials") {
    const TriangleMesh corners =
        read_vrml(shape("coordIndex [ 0 1 2 -1 0 2 3 -1 ] color Color { color [ 1 0 0, 0 1 0 ] } "
                        "colorIndex [ 0 0 0 -1 1 0 0 -1 ]"));
    CHECK(corners.triangles == std::vector<Triangle>{{0, 1, 2}, {4, 2, 3}});
    CHECK(corners.vertices_m[4] == corners.vertices_m[0]);
    CHECK(corners.colours[0] == glm::vec3(1.0F, 0.0F, 0.0F));
    CHECK(corners.colours[4] == glm::vec3(0.0F, 1.0F, 0.0F));
    const TriangleMesh faces =
        read_vrml(shape("coordIndex [ 0 1 2 -1 0 2 3 -1 ] color Color { color [ 1 0 0, 0 1 0 ] } "
                        "colorPerVertex FALSE colorIndex [ 1 0 ]"));
    REQUIRE(faces.materials.size() == 2);
    CHECK(faces.materials[faces.triangle_materials[0]].colour == glm::vec3(0.0F, 1.0F, 0.0F));
    CHECK(faces.colours.empty());
}

TEST_CASE("VRML normals follow their indices; ccw FALSE turns the faces") {
    const TriangleMesh mesh = read_vrml(shape("ccw FALSE coordIndex [ 0 1 2 -1 0 2 3 -1 ] normalPerVertex FALSE "
                                              "normal Normal { vector [ 0 0 -1, 0 0.6 -0.8 ] } normalIndex [ 1 0 ]"));
    CHECK(mesh.triangles == std::vector<Triangle>{{2, 1, 0}, {3, 2, 0}});
    CHECK(mesh.normals[mesh.corner_normals[0][2]] == glm::vec3(0.0F, 0.6F, -0.8F));
    CHECK(mesh.normals[mesh.corner_normals[1][0]] == glm::vec3(0.0F, 0.0F, -1.0F));
}

TEST_CASE("VRML materials are known by their node") {
    const TriangleMesh mesh =
        read_vrml("Shape { appearance DEF A Appearance { material DEF red Material { diffuseColor 1 0 0 } } "
                  "geometry IndexedFaceSet { " +
                  points +
                  "coordIndex [ 0 1 2 ] } }\n"
                  "Shape { appearance USE A geometry IndexedFaceSet { " +
                  points +
                  "coordIndex [ 0 1 2 ] } }\n"
                  "Switch { whichChoice 1 choice [ Group { } " +
                  shape("coordIndex [ 0 1 3 ]") + " ] }\n");
    REQUIRE(mesh.materials.size() == 2);
    CHECK(mesh.materials[0].name == "red");
    CHECK(mesh.materials[1].name == "default");
    CHECK(mesh.triangle_materials == std::vector<std::uint32_t>{0, 0, 1});
}

TEST_CASE("a faulty VRML file is refused in one line that says where") {
    CHECK(error_of("part.wrl", "#VRML V1.0 ascii\n") == "part.wrl:1: expected '#VRML V2.0', got '#VRML V1.0 ascii'");
    CHECK(refused_vrml("Group {\n") == "part.wrl:3: expected a field or '}', got the end of the file");
    CHECK(refused_vrml("Group { children [\n") == "part.wrl:3: expected ']', got the end of the file");
    CHECK(refused_vrml("DEF A Group { children USE A }") ==
          "part.wrl:2: expected a name that DEF gave to a node before, got 'A'");
    CHECK(refused_vrml(shape("coordIndex [ 0 1 4 ]")) == "part.wrl:2: expected a point below 4, got 4");
    CHECK(refused_vrml(shape("coordIndex [ 0 1 -2 ]")) == "part.wrl:2: expected a point below 4, got -2");
    CHECK(refused_vrml(shape("coordIndex [ 0 1 -1 ]")) == "part.wrl:2: expected faces of 3 to 10000 corners, got 2");
    CHECK(refused_vrml(shape("coordIndex [ 0 1 2.5 ]")) == "part.wrl:2: expected a whole number, got '2.5'");
    CHECK(refused_vrml(shape("coordIndex [ 0 1 2 ] normal Normal { vector [ 0 0 ] }")) ==
          "part.wrl:2: expected a number, got the end of the file");
    CHECK(refused_vrml(shape("coordIndex [ 0 1 2 ] colorIndex [ 0 0 ] color Color { color 0 0 2 }")) ==
          "part.wrl:2: expected colours of numbers 0..1, got 2");
    std::string deep;
    for (int i = 0; i < 300; ++i) { deep += "Group { children [\n"; }
    CHECK(refused_vrml(deep) == "part.wrl:103: expected nodes at most 100 deep, got a deeper one");
    std::string doubling = "DEF N0 " + shape("coordIndex [ 0 1 2 ]");
    for (int i = 0; i < 60; ++i) {
        doubling += "DEF N" + std::to_string(i + 1) + " Group { children [ USE N" + std::to_string(i) + " USE N" +
                    std::to_string(i) + " ] }\n";
    }
    CHECK_THAT(refused_vrml(doubling), Catch::Contains("expected at most 1000000 nodes, 200 deep"));
}
