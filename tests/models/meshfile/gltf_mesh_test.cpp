#include "models/material.h"
#include "models/meshfile/mesh_file.h"
#include "sim/base/binary_file.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <bit>

using namespace octant::models;
using octant::base64_of;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;
using namespace octant::tests;

namespace {

/// Places (0 0 0), (1 0 0), (0 1 0), (1 1 0) as floats, then 0 1 2 3 as bytes: 52 bytes.
std::string square_bytes() {
    std::string bytes;
    for (const float part : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 1.0F, 1.0F, 0.0F}) {
        const auto own = std::bit_cast<std::array<char, 4>>(part);
        bytes.append(own.data(), 4);
    }
    return bytes + std::string("\0\1\2\3", 4);
}

struct Parts {
    std::string nodes = R"([{"mesh":0}])";
    std::string primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":5})";
    std::string accessors =
        R"([{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
            {"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"}])";
    std::string views = R"([{"buffer":0,"byteLength":48},
               {"buffer":0,"byteOffset":48,"byteLength":4}])";
    std::string uri = "data:application/octet-stream;base64," + base64_of(square_bytes());
    std::string more;
};

std::string gltf(const Parts& parts) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + parts.nodes +
           R"(,"meshes":[{"primitives":[)" + parts.primitive + R"(]}],"accessors":)" + parts.accessors +
           R"(,"bufferViews":)" + parts.views + R"(,"buffers":[{"byteLength":52,"uri":")" + parts.uri + "\"}]" +
           parts.more + "}";
}

TriangleMesh read_gltf(const Parts& parts) {
    TriangleMesh mesh = read_mesh(file_with("part.gltf", gltf(parts)));
    CHECK(index_fault(mesh).empty());
    return mesh;
}

std::string refused_gltf(const Parts& parts) { return error_of("part.gltf", gltf(parts)); }

} // namespace

TEST_CASE("strips, fans and lists of glTF give the triangles that they stand for") {
    CHECK(read_gltf({}).triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
    Parts fan;
    fan.primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":6})";
    CHECK(read_gltf(fan).triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    Parts plain;
    plain.primitive = R"({"attributes":{"POSITION":0},"mode":5})";
    CHECK(read_gltf(plain).triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
    Parts lines;
    lines.primitive = R"({"attributes":{"POSITION":0},"mode":1},)" + Parts().primitive;
    CHECK(read_gltf(lines).notes.size() == 1);
}

TEST_CASE("places of glTF may be short numbers, which their node makes as large as they are") {
    std::string bytes;
    for (const int part : {0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0, 0, 100, 100, 0, 0}) { // 4 apiece
        bytes += static_cast<char>(part);
        bytes += '\0';
    }
    Parts parts;
    parts.uri =
        "data:application/octet-stream;base64," + base64_of(bytes + std::string(16, '\0') + std::string("\0\1\2\3", 4));
    parts.accessors = R"([{"bufferView":0,"componentType":5122,"count":4,"type":"VEC3"},
            {"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"}])";
    parts.views = R"([{"buffer":0,"byteLength":32,"byteStride":8},
               {"buffer":0,"byteOffset":48,"byteLength":4}])";
    parts.nodes = R"([{"mesh":0,"scale":[0.01,0.01,0.01]}])";
    parts.more = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
    const TriangleMesh mesh = read_gltf(parts);
    CHECK(mesh.triangles.size() == 2);
    CHECK(mesh.vertices_m.at(3).x == Approx(1.0));
    CHECK(mesh.vertices_m.at(3).y == Approx(1.0));
}

TEST_CASE("nodes of glTF place their meshes; a mirror turns triangles round again") {
    Parts parts;
    parts.nodes = R"([{"children":[1,2],"translation":[10,0,0]},
        {"mesh":0,"rotation":[0,0,0.70710678118654752,0.70710678118654752],"scale":[2,1,1]},
        {"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]}])";
    const TriangleMesh mesh = read_gltf(parts);
    REQUIRE(mesh.vertices_m.size() == 8);
    CHECK(glm::distance(mesh.vertices_m[1], glm::dvec3(10.0, 2.0, 0.0)) < 1e-12);
    CHECK(glm::distance(mesh.vertices_m[2], glm::dvec3(9.0, 0.0, 0.0)) < 1e-12);
    CHECK(mesh.vertices_m[5] == glm::dvec3(9.0, 0.0, 5.0));
    CHECK(mesh.triangles[0] == Triangle{0, 1, 2});
    CHECK(mesh.triangles[2] == Triangle{4, 6, 5});
}

TEST_CASE("primitives of one glTF mesh share the vertices of the same accessor") {
    Parts parts;
    parts.primitive = Parts().primitive + "," + R"({"attributes":{"POSITION":0},"indices":1,"mode":6,"material":1})";
    parts.more = R"(,"materials":[{},{"name":"red","pbrMetallicRoughness":
        {"baseColorFactor":[1,0.5,0,1]}}])";
    const TriangleMesh mesh = read_gltf(parts);
    CHECK(mesh.vertices_m.size() == 4);
    REQUIRE(mesh.materials.size() == 2);
    CHECK(mesh.materials[0].name == "red");
    CHECK(mesh.materials[0].colour == glm::vec3(1.0F, 0.735357F, 0.0F)); // linear in the file
    CHECK(mesh.triangle_materials == std::vector<std::uint32_t>{1, 1, 0, 0});
}

TEST_CASE("a display value is brighter than the light it stands for, and comes back to the bit") {
    CHECK(linear_from_srgb(glm::dvec3(0.5)).x == Approx(0.214041));
    CHECK(linear_from_srgb({0.0, 0.04045, 1.0}).y == Approx(0.04045 / 12.92));
    for (int step = 0; step <= 1000; ++step) {
        const glm::vec3 display(static_cast<float>(step) / 1000.0F);
        CHECK(glm::vec3(srgb_from_linear(linear_from_srgb(glm::dvec3(display)))) == display);
    }
}

TEST_CASE("colours of glTF in bytes stand for 0 to 1, linear in light") {
    Parts parts;
    parts.primitive = R"({"attributes":{"POSITION":0,"COLOR_0":2},"mode":5})";
    parts.accessors.pop_back();
    parts.accessors += R"(,{"bufferView":0,"byteOffset":12,"componentType":5121,
        "normalized":true,"count":4,"type":"VEC4"}])";
    const TriangleMesh mesh = read_gltf(parts);
    CHECK(mesh.colours[0].z == Approx(0.7366).margin(1e-4)); // 1.0F is 00 00 80 3f
}

TEST_CASE("data of glTF may lie in files beside it, but not outside its folder") {
    file_with("square data.bin", square_bytes());
    Parts parts;
    parts.uri = "square%20data.bin";
    CHECK(read_gltf(parts).triangles.size() == 2);
    for (const std::string uri :
        {"../x.bin", "/etc/passwd", "a/../../x.bin", "%2e%2e/x.bin", "file:///x", "..\\\\x", ""}) {
        parts.uri = uri;
        CHECK_THAT(refused_gltf(parts),
            Catch::StartsWith("part.gltf: buffers[0].uri: expected a file in the folder of this one, got '"));
    }
    parts.uri = "none.bin";
    CHECK(
        refused_gltf(parts) == "part.gltf: buffers[0].uri: expected a file that lies beside this one, got 'none.bin'");
}

TEST_CASE("a faulty glTF file is refused in one line that says what") {
    CHECK(error_of("part.gltf", "{\n\"a\":\n") == "part.gltf:3: expected JSON, got the end of the text");
    CHECK(error_of("part.gltf", "{\n\"a\": tru}\n") == "part.gltf:2: expected JSON, got '}?'");
    CHECK(error_of("part.gltf", "[]") == "part.gltf: expected a JSON object, got '[]'");
    CHECK(error_of("part.gltf", R"({"asset":{"version":"1.0"}})") ==
          "part.gltf: asset.version: expected 2.0, got '\"1.0\"'");
    CHECK(error_of("part.gltf", std::string(100000, '[')) == "part.gltf: expected JSON at most 64 deep, got more");
    Parts parts;
    parts.nodes = R"([{"mesh":7}])";
    CHECK(refused_gltf(parts) == "part.gltf: nodes[0].mesh: expected a whole number below 1, got '7'");
    parts.nodes = R"([{"mesh":0,"children":[0]}])";
    CHECK(refused_gltf(parts) == "part.gltf: nodes[0]: expected a node with one parent, got one that is met again");
    parts = {};
    parts.accessors =
        R"([{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"},
            {"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"}])";
    CHECK(refused_gltf(parts) == "part.gltf: accessors[0]: expected 1 or more entries that fit the 48 bytes of the "
                                 "view, got 5 from byte 0, 12 apart");
    parts.accessors =
        R"([{"sparse":{},"componentType":5126,"count":5,"type":"VEC3"},
            {"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"}])";
    CHECK(refused_gltf(parts) == "part.gltf: accessors[0]: expected an accessor that is not sparse, got a sparse one");
    parts.accessors =
        R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
            {"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"}])";
    CHECK(refused_gltf(parts) == "part.gltf: meshes[0].primitives: expected indices below 3, got 3");
    parts = {};
    parts.more = R"(,"extensionsRequired":["KHR_draco_mesh_compression"])";
    CHECK(refused_gltf(parts) ==
          "part.gltf: extensionsRequired: expected accessors that Draco does not pack (gltf-transform copy IN.glb "
          "OUT.glb or Blender unpacks them), got KHR_draco_mesh_compression");
    CHECK(error_of("part.glb", std::string("glTF\2\0\0\0\77\0\0\0", 12)) ==
          "part.glb: at byte 8: expected a length of 12, got 63");
}
