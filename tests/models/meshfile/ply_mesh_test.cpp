#include "models/meshfile/mesh_file.h"
#include "models/triangle_mesh.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>

using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;
using namespace octant::tests;

namespace {

const std::string start = "ply\nformat ascii 1.0\n";
const std::string places = "property float x\nproperty float y\nproperty float z\n";
const std::string ply_corners = "property list uchar int vertex_indices\n";

std::string refused_ply(const std::string& text) { return error_of("part.ply", text); }

TriangleMesh read_ply_text(const std::string& bytes) {
    TriangleMesh mesh = read_mesh(file_with("part.ply", bytes));
    CHECK(index_fault(mesh).empty());
    return mesh;
}

/// A binary PLY's body, byte order as asked.
class Body {
public:
    explicit Body(std::endian order) : turned_(order != std::endian::native) {}

    template <typename T>
    Body& add(T value) {
        auto own = std::bit_cast<std::array<char, sizeof(T)>>(value);
        if (turned_) { std::ranges::reverse(own); }
        bytes_.append(own.data(), own.size());
        return *this;
    }

    const std::string& bytes() const { return bytes_; }

private:
    bool turned_;
    std::string bytes_;
};

} // namespace

TEST_CASE("an ascii PLY with what it need not have is read") {
    const TriangleMesh mesh =
        read_ply_text(start + "comment hello\nobj_info 3\nelement camera 1\nproperty list char float a\n" +
                      "property float b\nelement vertex 4\nproperty uchar red\n" + places +
                      "property float confidence\nproperty uchar green\nproperty uchar blue\n" +
                      "property list uint8 int8 owners\nelement face 1\nproperty uchar flags\n" +
                      "property list uint8 int32 vertex_index\nproperty list uchar float texcoord\n" +
                      "element edge 1\nproperty int v\nend_header\n"
                      "2 0.5 nan 7\n"
                      "255 0 0 0 nan 0 51 0\n0 1 0 0 1 0 0 2 1 2\n0 1 1\n 0 1 0 0 0\n0 0 1 0 1 0 0 0\n"
                      "3 4 0 1 2 3 6 0 0 0 0 0 0\n8");
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(mesh.vertices_m[2] == glm::dvec3(1.0, 1.0, 0.0));
    REQUIRE(mesh.colours.size() == 4);
    CHECK(mesh.colours[0] == glm::vec3(1.0F, 0.0F, 0.2F));
    CHECK(mesh.normals.empty());
}

TEST_CASE("strips of a PLY file give triangles that look the same way") {
    const std::string head = start + "element vertex 6\n" + places +
                             "element tristrips 1\nproperty list int int vertex_indices\n"
                             "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n";
    const TriangleMesh mesh = read_ply_text(head + "11 0 1 2 3 3 4 -1 2 3 4 5\n");
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}});
    CHECK(refused_ply(head + "3 0 1 6\n") == "part.ply:16: expected a vertex below 6, got 6");
    CHECK(refused_ply(head + "3 0 1 -1\n") == "part.ply: expected at least one triangle, got none");
}

TEST_CASE("binary PLY files of both byte orders are read alike") {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        Body body(order);
        body.add(std::uint16_t{2}).add(1.0).add(2.0); // a list that nobody wants
        for (const glm::vec3 place : {glm::vec3(0.0F), {1.0F, 0.0F, 0.0F}, {0.0F, 1.5F, 0.0F}}) {
            body.add(static_cast<double>(place.x)).add(place.y).add(std::int16_t{7}).add(place.z);
            body.add(0.0F).add(0.0F).add(2.0F).add(0.25F).add(0.5F).add(1.0F);
        }
        body.add(std::int32_t{3}).add(std::uint16_t{0}).add(std::uint16_t{1});
        body.add(std::uint16_t{2}).add(std::int8_t{-1});
        const TriangleMesh mesh = read_ply_text(
            std::string("ply\r\nformat ") + (order == std::endian::big ? "binary_big_endian" : "binary_little_endian") +
            " 1.0\r\nelement extra 1\r\nproperty list ushort double stuff\r\n"
            "element vertex 3\r\nproperty double x\r\nproperty float y\r\nproperty short w\r\n"
            "property float z\r\nproperty float nx\r\nproperty float ny\r\nproperty float nz\r\n"
            "property float red\r\nproperty float green\r\nproperty float blue\r\n"
            "element face 1\r\nproperty list int ushort vertex_indices\r\nproperty char c\r\n"
            "end_header\r\n" +
            body.bytes());
        CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
        CHECK(mesh.vertices_m[2] == glm::dvec3(0.0, 1.5, 0.0));
        CHECK(mesh.normals[1] == glm::vec3(0.0F, 0.0F, 1.0F));
        CHECK(mesh.colours[1] == glm::vec3(0.25F, 0.5F, 1.0F));
    }
}

TEST_CASE("a faulty PLY header is refused in one line that says where") {
    CHECK(refused_ply("plo\n") == "part.ply:1: expected 'ply', got 'plo'");
    CHECK(refused_ply("ply\nelement vertex 3\n") == "part.ply:3: expected end_header, got the end of the file");
    CHECK(refused_ply("ply\nformat ascii 2.0\n") == "part.ply:2: expected 'format FORM 1.0', got 'format ascii 2.0'");
    CHECK(refused_ply("ply\nformat utf 1.0\n") ==
          "part.ply:2: expected ascii, binary_little_endian or binary_big_endian, got 'utf'");
    CHECK(refused_ply(start + "property int a\n") ==
          "part.ply:3: expected an element before its property, got 'property int a'");
    CHECK(refused_ply(start + "element vertex -3\n") ==
          "part.ply:3: expected 'element NAME COUNT', got 'element vertex -3'");
    CHECK(refused_ply(start + "element vertex 3\nproperty real x\n") ==
          "part.ply:4: expected a type such as uchar, int or float, got 'real'");
    CHECK(refused_ply(start + "element vertex 3\nproperty list float int x\n") ==
          "part.ply:4: expected a whole number as the count of a list, got 'property list float int x'");
    CHECK(refused_ply(start + "hello\n") ==
          "part.ply:3: expected format, element, property, comment or end_header, got 'hello'");
    CHECK(refused_ply("ply\nend_header\n") == "part.ply:2: expected a format line in the header, got none");
}

TEST_CASE("a PLY header that promises more than the file holds is refused by its size") {
    CHECK(refused_ply(start + "element vertex 2147483648\n" + places + "end_header\n0 0 0\n") ==
          "part.ply:3: expected at most 1 of 'vertex' in a file of this size, got 2147483648");
    CHECK(refused_ply("ply\nformat binary_little_endian 1.0\nelement face 9000000000000000000\n" + ply_corners +
                      "end_header\nabc") ==
          "part.ply:3: expected at most 3 of 'face' in a file of this size, got 9000000000000000000");
    // An element without properties takes no bytes, and must take no time either.
    CHECK(refused_ply(start + "element nothing 9000000000000000000\nend_header\n") ==
          "part.ply: expected at least one triangle, got none");
}

TEST_CASE("a faulty PLY body is refused in one line that says where") {
    const std::string header = start + "element vertex 3\n" + places +
                               "property uchar red\nproperty uchar green\nproperty uchar blue\n" + "element face 1\n" +
                               ply_corners + "end_header\n";
    const std::string good = "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n";
    CHECK(refused_ply(header + good + "3 0 1 2\n").empty());
    CHECK(refused_ply(header + good + "3 0 1 3\n") == "part.ply:16: expected a vertex below 3, got 3");
    CHECK(refused_ply(header + good + "3 0 1 -1\n") == "part.ply:16: expected a vertex below 3, got -1");
    CHECK(refused_ply(header + good + "2 0 1 2\n") == "part.ply:16: expected a face of 3 to 10000 corners, got 2");
    CHECK(refused_ply(header + good + "3 0 1\n") ==
          "part.ply:17: expected the number of a vertex, got the end of the file");
    CHECK(refused_ply(header + "0 0 inf 1 2 3\n" + good) == "part.ply:13: expected a coordinate, got 'inf'");
    CHECK(refused_ply(header + "0 0 0 1 256 3\n" + good) ==
          "part.ply:13: expected a part of a colour of 0 to 255, got 256");
    CHECK(refused_ply(start + "element face 0\n" + ply_corners + "end_header\n") ==
          "part.ply:6: expected the element vertex before the element face, got face first");
    CHECK(refused_ply(start + "element vertex 0\nproperty float x\nend_header\n") ==
          "part.ply:6: expected the properties x, y and z of a vertex, got fewer");
}

TEST_CASE("a faulty binary PLY body is refused in one line that names the byte") {
    const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 1\n" + places +
                               "element face 1\n" + ply_corners + "end_header\n";
    const auto at = [&](std::size_t byte) {
        return "part.ply: at byte " + std::to_string(header.size() + byte) + ": expected ";
    };
    Body body(std::endian::little);
    body.add(0.0F).add(std::bit_cast<float>(0x7fc00000U)).add(0.0F);
    CHECK_THAT(refused_ply(header + body.bytes() + "a"), Catch::StartsWith(at(4) + "a coordinate"));
    Body cut(std::endian::little);
    cut.add(0.0F).add(0.0F).add(0.0F).add(std::uint8_t{3}).add(std::int32_t{0});
    CHECK(
        refused_ply(header + cut.bytes()) == at(17) + "the number of a vertex (4 bytes), got 0 to the end of the file");
}

TEST_CASE("a mesh written as PLY comes back the same, but for materials") {
    TriangleMesh before = coloured_cube();
    for (const bool is_double : {false, true}) {
        if (is_double) {
            before.vertices_m[3].x = 1.1;   // no float
            before.colours[2].y = 0.12345F; // no part of 255
        }
        const std::filesystem::path path = scratch_file("cube.ply");
        write_mesh(path, before);
        const TriangleMesh after = read_mesh(path);
        CHECK(after.vertices_m == before.vertices_m);
        CHECK(after.colours == before.colours);
        CHECK(after.triangles == before.triangles);
        CHECK(after.normals.empty()); // the cube's vertices have three each
        CHECK(after.materials.empty());
    }
    TriangleMesh smooth = tetrahedron();
    smooth.normals = {{-1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {0.6F, 0.0F, 0.8F}};
    smooth.corner_normals = smooth.triangles;
    const std::filesystem::path path = scratch_file("smooth.ply");
    write_mesh(path, smooth);
    const TriangleMesh after = read_mesh(path);
    CHECK(after.normals == smooth.normals);
    CHECK(after.corner_normals == smooth.corner_normals);
}

TEST_CASE("texture coordinates of a PLY file's vertices and of its faces are read") {
    const TriangleMesh of_vertices =
        read_mesh(file_with("st.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                      "property float z\nproperty float texture_u\nproperty float texture_v\n"
                                      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                      "0 0 0 0.125 0.25\n1 0 0 0.5 0.25\n0 1 0 0.125 1\n3 2 0 1\n"));
    REQUIRE(of_vertices.corner_texture_coordinates.size() == 1);
    CHECK(of_vertices.corner_texture_coordinates[0] == of_vertices.triangles[0]);
    CHECK(of_vertices.texture_coordinates[2] == glm::vec2(0.125F, 1.0F));
    const TriangleMesh of_faces = read_mesh(
        file_with("texcoord.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                                  "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
                                  "property list uchar float texcoord\nend_header\n"
                                  "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 0 0 0.5 0 0.5 1\n3 0 2 3 0\n"));
    REQUIRE(of_faces.corner_texture_coordinates.size() == 2);
    const Triangle& corners = of_faces.corner_texture_coordinates[0];
    CHECK(of_faces.texture_coordinates[corners[1]] == glm::vec2(0.5F, 0.0F));
    CHECK(of_faces.texture_coordinates[corners[2]] == glm::vec2(0.5F, 1.0F));
    CHECK(of_faces.corner_texture_coordinates[1][0] == invalid_index);
}
