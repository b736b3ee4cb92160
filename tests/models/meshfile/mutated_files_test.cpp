#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_file.h"
#include "models/repair/repair.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "tests/models/meshfile/chain_samples.h"
#include "tests/models/meshfile/mesh_samples.h"
#include "tests/models/meshfile/mutations.h"

#include <catch2/catch.hpp>

#include <iostream>
#include <utility>

using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::repair;
using namespace octant::models::meshfile::test;
using namespace octant::tests;

namespace {

constexpr std::uint32_t mutations = 1000;

struct Outcome {
    int read = 0;
    int refused = 0;
};

/// What is wrong with a mesh as read or as repaired; empty when nothing is.
std::string fault_of(const TriangleMesh& mesh) {
    const std::string fault = index_fault(mesh);
    if (!fault.empty()) { return "read: " + fault; }
    const TriangleMesh mended = repaired(mesh).mesh;
    const std::string after = index_fault(mended);
    return after.empty() ? manifold_fault(mended) : "repaired: " + after;
}

std::string fault_of(const LevelChain& chain) {
    for (const ChainLevel& level : chain.levels) {
        const std::string fault = fault_of(level.mesh);
        if (!fault.empty()) { return fault; }
    }
    return chain.levels.empty() ? "no levels" : "";
}

/// Reads each mutation of a file: it is sound or refused in one line.
template <typename Read>
void check_mutations(const std::string& name, const std::string& good, const Read& read, bool seal = false) {
    Outcome outcome;
    const std::filesystem::path path = scratch_file(name);
    for (std::uint32_t seed = 0; seed < mutations; ++seed) {
        std::string bytes = mutated(good, seed);
        if (seal) { bytes = sealed(std::move(bytes)); }
        file_with(name, bytes);
        std::string fault;
        try {
            fault = fault_of(read(path));
            ++outcome.read;
        } catch (const octant::Error& error) {
            const std::string line = error.what();
            if (line.empty() || line.find_first_of("\r\n") != std::string::npos) {
                fault = "a message that is not one line: " + line;
            }
            ++outcome.refused;
        }
        if (!fault.empty()) { FAIL_CHECK(name << ", seed " << seed << ": " << fault); }
    }
    // Otherwise the faults missed the file, or the file was none to begin with.
    CHECK(outcome.read > 0);
    CHECK(outcome.refused > 100);
    std::cout << name << ": " << outcome.read << " read, " << outcome.refused << " refused\n";
}

void check_mesh_mutations(const std::string& name, const std::string& good) {
    INFO(name);
    check_mutations(name, good,
        [](const std::filesystem::path& path) { return read_mesh(path, {.pictures = true, .backs = true}); });
}

std::string written(const std::string& name, const TriangleMesh& mesh) {
    const std::filesystem::path path = scratch_file(name);
    write_mesh(path, mesh);
    return octant::read_file(path);
}

std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

} // namespace

TEST_CASE("a mutated OBJ file is read soundly or refused in one line") {
    check_mesh_mutations("cube.obj", written("cube.obj", coloured_cube()) + "f -1 -2 -3 -4 1/2/3\n");
}

TEST_CASE("a mutated PLY file is read soundly or refused in one line") {
    check_mesh_mutations("ascii.ply",
        "ply\nformat ascii 1.0\ncomment c\nelement vertex 5\nproperty float x\nproperty float y\n"
        "property double z\nproperty float nx\nproperty float ny\nproperty float nz\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        "property list uchar int extra\nelement face 3\nproperty list uchar int vertex_indices\n"
        "property int flags\nelement edge 1\nproperty int a\nend_header\n"
        "0 0 0 0 0 1 255 0 1 0\n1 0 0 0 0 1 3 4 5 2 1 2\n1 1 0 0 0 1 3 4 5 0\n"
        "0 1 0 0 1 0 9 9 9 0\n0.5 0.5 1 0 0 1 3 4 5 0\n4 0 3 2 1 7\n3 0 1 4 8\n3 1 2 4 9\n5\n");
    check_mesh_mutations("little.ply", written("a.ply", coloured_cube()));
    TriangleMesh smooth = tetrahedron();
    smooth.vertices_m[1].x = 1.1;
    smooth.normals = {{0.0F, 0.0F, 1.0F}};
    smooth.corner_normals.assign(4, {0, 0, 0});
    check_mesh_mutations("double.ply", written("b.ply", smooth));
    // Vertices of bytes read the same from either end.
    check_mesh_mutations(
        "big.ply", "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty uchar x\nproperty uchar y\n"
                   "property uchar z\nelement face 2\nproperty list ushort uint vertex_indices\nend_header\n" +
                       std::string("\0\0\0\1\0\0\1\1\0\0\1\0", 12) +
                       std::string("\0\3\0\0\0\0\0\0\0\1\0\0\0\2\0\3\0\0\0\0\0\0\0\2\0\0\0\3", 28));
}

TEST_CASE("a mutated FlightGear model is read soundly or refused in one line") {
    write_mesh(scratch_file("part.ac"), coloured_cube());
    check_mesh_mutations("model.xml",
        "<?xml version=\"1.0\"?>\n<!-- a --><PropertyList>\n<path>part.ac</path>\n<model>"
        "<path>part.ac</path><offsets><x-m>1.5</x-m><pitch-deg>30</pitch-deg></offsets></model>"
        "<animation><type>select</type><object-name>cube</object-name><condition><not><property>"
        "a</property></not></condition></animation>\n</PropertyList>\n");
}

TEST_CASE("a mutated STL file is read soundly or refused in one line") {
    std::string ascii = "solid a\n";
    const TriangleMesh mesh = cube();
    for (const Triangle& triangle : mesh.triangles) {
        ascii += "facet normal 0 0 1\nouter loop\n";
        for (const std::uint32_t vertex : triangle) {
            const glm::dvec3& place_m = mesh.vertices_m[vertex];
            ascii += "vertex " + std::to_string(place_m.x) + " " + std::to_string(place_m.y) + " " +
                     std::to_string(place_m.z) + "\n";
        }
        ascii += "endloop\nendfacet\n";
    }
    check_mesh_mutations("ascii.stl", ascii + "endsolid a\n");
    check_mesh_mutations("binary.stl", written("c.stl", cube()));
}

TEST_CASE("a mutated glTF file is read soundly or refused in one line") {
    const std::string gltf = with(written("cube.gltf", coloured_cube()), R"("nodes":[{"mesh":0}])",
        R"("nodes":[{"children":[1,2],"scale":[1,2,3]},{"mesh":0,"rotation":[0,0,1,0]},)"
        R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,-1,0,3,0,0,1]}])");
    check_mesh_mutations("cube.gltf", gltf);
    check_mesh_mutations("cube.glb", written("cube.glb", coloured_cube()));
}

TEST_CASE("a mutated AC3D file is read soundly or refused in one line") {
    check_mesh_mutations(
        "cube.ac", with(written("cube.ac", coloured_cube()), "kids 1\n",
                       "kids 2\nOBJECT poly\nname \"x\"\ndata 3\nabc\nrot 0 -1 0 1 0 0 0 0 1\nloc 1 2 3\n"
                       "texture \"t\"\nnumvert 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nnumsurf 2\nSURF 0x30\nmat 0\n"
                       "refs 4\n0 0 0\n1 0 0\n2 1 1\n3 0 1\nSURF 0x2\nmat 0\nrefs 2\n0 0 0\n1 0 0\nkids 0\n"));
}

TEST_CASE("a mutated VRML file is read soundly or refused in one line") {
    check_mesh_mutations(
        "cube.wrl", written("cube.wrl", coloured_cube()) +
                        "PROTO P [ ] { Group { } }\nTransform { rotation 0 1 0 1.5 scale 1 2 -1 translation 4 "
                        "0 0\n children [ USE hull # comment\n Shape { geometry IndexedFaceSet { ccw FALSE\n"
                        "coord USE points color Color { color [ 1 0 0, 0 1 0 ] } colorIndex [ 0 1 ]\n"
                        "colorPerVertex FALSE coordIndex [ 0 1 3 2 -1 4 5 7 6 -1 ] } } ] }\n");
}

TEST_CASE("a mutated chain is refused; with a checksum that fits it is read soundly or refused") {
    const std::filesystem::path path = scratch_file("good.chain");
    write_chain(path, sample_chain());
    const std::string good = octant::read_file(path);
    for (std::uint32_t seed = 0; seed < mutations; ++seed) {
        const std::string bytes = mutated(good, seed);
        const std::filesystem::path changed = file_with("changed.chain", bytes);
        if (bytes != good) {
            try {
                read_chain(changed);
                // The word for later in the head is not read.
                CHECK(bytes.substr(0, 12) + bytes.substr(16) == good.substr(0, 12) + good.substr(16));
            } catch (const octant::Error& error) { CHECK(std::string(error.what()).find('\n') == std::string::npos); }
        }
    }
    check_mutations("sealed.chain", good, read_chain, true);
}
