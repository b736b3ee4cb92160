#include "models/meshfile/mesh_file.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>

using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;
using namespace octant::tests;

namespace {

std::string facet(const std::string& corners) {
    return "facet normal nan 0 1\n outer loop\n" + corners + " endloop\nendfacet\n";
}

const std::string first = " vertex 0 0 0\n vertex 1 0 0\n vertex 0 1e0 0\n";
const std::string second = " VERTEX 0 1 0\n VERTEX 1 0 -0\n VERTEX 1 1 0\n";

std::string refused_stl(const std::string& text) { return error_of("part.stl", text); }

std::string binary_cube() {
    const std::filesystem::path path = scratch_file("cube.stl");
    write_mesh(path, cube());
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace

TEST_CASE("an ascii STL is welded where corners have equal places") {
    const TriangleMesh mesh = read_mesh(file_with(
        "part.stl", "solid my part\n" + facet(first) + "endsolid my part\nSOLID two\n" + facet(second) + "endsolid\n"));
    CHECK(mesh.vertices_m.size() == 4);
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}});
    CHECK(mesh.normals.empty());
}

TEST_CASE("a binary STL that begins with the word solid is known by its size") {
    std::string bytes = binary_cube();
    CHECK(bytes.size() == 84 + 12 * 50);
    bytes.replace(0, 6, "solid ");
    CHECK(read_mesh(file_with("part.stl", bytes)).triangles.size() == 12);
}

TEST_CASE("bytes behind the last triangle of a binary STL are noted") {
    const TriangleMesh mesh = read_mesh(file_with("part.stl", binary_cube() + "abc"));
    CHECK(mesh.triangles.size() == 12);
    REQUIRE(mesh.notes.size() == 1);
    CHECK_THAT(mesh.notes[0], Catch::Contains("3 bytes behind the last triangle"));
}

TEST_CASE("a faulty STL file is refused in one line that says where") {
    CHECK(refused_stl("solid\n" + facet(first)) == "part.stl:9: expected facet or endsolid, got the end of the file");
    CHECK(refused_stl("solid\nfacet normal 0 0 1\nouter lop\n") == "part.stl:3: expected loop, got 'lop'");
    CHECK(refused_stl("solid\n" + facet(" vertex 0 0 nan\n")) == "part.stl:4: expected a coordinate, got 'nan'");
    CHECK(refused_stl("solid\nendsolid\n") == "part.stl: expected at least one triangle, got none");
    std::string bytes = binary_cube();
    CHECK(refused_stl(bytes.substr(0, bytes.size() - 1)) ==
          "part.stl: at byte 80: expected at most 11 triangles in a file of this size, got 12");
    bytes.replace(80, 4, "\xff\xff\xff\xff");
    CHECK(refused_stl(bytes) == "part.stl: at byte 80: expected at most 12 triangles in a file of "
                                "this size, got 4294967295");
    bytes = binary_cube();
    bytes.replace(84 + 12, 4, std::string("\0\0\x80\x7f", 4));
    CHECK(refused_stl(bytes) == "part.stl: at byte 96: expected a coordinate, got inf");
    CHECK(refused_stl("abc") == "part.stl: at byte 0: expected a header (80 bytes), got 3 to the end of the file");
}
