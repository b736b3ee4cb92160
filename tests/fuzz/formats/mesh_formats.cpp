// Mesh files, polygon files, level chains and progressive meshes.
#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/meshopt_decoder.h"
#include "models/polygons/obj_reader.h"
#include "models/polygons/obj_writer.h"
#include "models/polygons/polygon_model.h"
#include "models/simplify/simplify.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/text_file.h"
#include "tests/fuzz/formats/samples.h"
#include "tests/fuzz/formats/target.h"
#include "tests/sample_meshes.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/progressive_file.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>

namespace octant::tests::formats {

namespace {

namespace ac3d {

constexpr const char* scene =
    "AC3Db\nMATERIAL \"m\" rgb 1 0.5 0  amb 0 0 0  emis 0 0 0  spec 0 0 0  shi 0  trans 0\n"
    "OBJECT world\nkids 2\nOBJECT group\nname \"g\"\nloc 0 1 0\nkids 1\nOBJECT poly\nname \"x\"\n"
    "data 3\nabc\nrot 0 -1 0 1 0 0 0 0 1\nloc 1 2 3\ntexture \"t\"\ntexrep 1 1\ncrease 30\n"
    "numvert 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nnumsurf 2\nSURF 0x30\nmat 0\nrefs 4\n0 0 0\n1 0 0\n"
    "2 1 1\n3 0 1\nSURF 0x2\nmat 0\nrefs 2\n0 0 0\n1 0 0\nkids 0\nOBJECT light\nkids 0\n";

std::vector<std::string> seeds() {
    std::vector<std::string> all = mesh_seeds(".ac");
    all.emplace_back(scene);
    return all;
}

const Registered target({
    .name = "ac3d",
    .file = "input.ac",
    .use = use_mesh_file,
    .seeds = seeds,
    .words = {"OBJECT ", "poly\n", "group\n", "kids ", "numvert ", "numsurf ", "SURF 0x", "mat ", "refs ", "data ",
        "rot ", "loc ", "MATERIAL "},
});

} // namespace ac3d

namespace chain {

using models::meshfile::LevelChain;

std::string chain_bytes(const LevelChain& chain) {
    return bytes_written("seed.chain", [&](const auto& file) { models::meshfile::write_chain(file, chain); });
}

std::vector<std::string> seeds() {
    LevelChain chain;
    chain.name = "cube and less";
    chain.levels.push_back({coloured_cube(), 0.0});
    std::vector<std::string> all{chain_bytes(chain)};
    chain.levels.push_back({tetrahedron(), 0.125});
    models::polygons::PolygonModel square;
    square.name = "square";
    square.vertices_m = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
    square.corner_vertices = {0, 1, 2, 3};
    square.polygons = {{0, 4, 0, 1}};
    square.materials = {{"grey", {0.5F, 0.5F, 0.5F}}};
    square.parts = {"body", "rotor"};
    square.pivots = {{1, {1.0, 2.0, 3.0}, {0.0, 1.0, 0.0}, 6.5}};
    chain.polygons = square;
    chain.polygons_error_m = 0.25;
    all.push_back(chain_bytes(chain));
    return all;
}

/// The size and the checksum in the head.
void seal(std::string& bytes) {
    constexpr std::size_t head = 32;
    if (bytes.size() < head) { return; }
    Hash hash;
    hash.add(std::as_bytes(std::span(bytes).subspan(head)));
    const std::uint64_t numbers[] = {bytes.size() - head, hash.value()};
    std::memcpy(bytes.data() + 16, numbers, sizeof numbers);
}

/// What was read is written and read again, to the same bytes.
void use(const std::filesystem::path& file) {
    const LevelChain chain = models::meshfile::read_chain(file);
    for (const models::meshfile::ChainLevel& level : chain.levels) { use_mesh(level.mesh); }
    const std::string written = chain_bytes(chain);
    const LevelChain again = models::meshfile::read_chain(input_folder() / "seed.chain");
    expect(chain_bytes(again) == written, "the same chain again");
}

const Registered target({.name = "chain", .file = "input.chain", .use = use, .seeds = seeds, .seal = seal});

} // namespace chain

namespace flightgear {

const Registered target({
    .name = "flightgear",
    .file = "input.xml",
    .use =
        [](const auto& file) {
            models::meshfile::write_mesh(file.parent_path() / "part.ac", coloured_cube());
            use_mesh_file(file);
        },
    .seeds =
        [] {
            return std::vector<std::string>{
                "<?xml version=\"1.0\"?>\n<!-- a --><PropertyList>\n<path>part.ac</path>\n<model><path>part.ac</path>"
                "<offsets><x-m>1.5</x-m><pitch-deg>30</pitch-deg></offsets></model><animation><type>select</type>"
                "<object-name>cube</object-name><condition><not><property>a</property></not></condition></animation>\n"
                "</PropertyList>\n"};
        },
    .words = {"<path>", "</path>", "<model>", "<animation>", "<type>", "<object-name>", "<offsets>", "include=\"",
        "<!--", "-->", "&lt;", "</PropertyList>"},
    .mutations = 1000,
});

} // namespace flightgear

namespace glb {

/// The length in the head and those of both chunks, the first as the file has it where it fits.
void seal(std::string& bytes) {
    constexpr std::size_t head = 12;
    constexpr std::size_t chunk_head = 8;
    const auto put = [&](std::size_t at, std::size_t value) {
        const auto number = static_cast<std::uint32_t>(value);
        std::memcpy(bytes.data() + at, &number, sizeof number);
    };
    if (bytes.size() < head + chunk_head) { return; }
    put(8, bytes.size());
    std::uint32_t json = 0;
    std::memcpy(&json, bytes.data() + head, sizeof json);
    const std::size_t second = head + chunk_head + json;
    if (second + chunk_head <= bytes.size()) {
        put(second, bytes.size() - second - chunk_head);
    } else {
        put(head, bytes.size() - head - chunk_head);
    }
}

const Registered target({
    .name = "glb",
    .file = "input.glb",
    .use = use_mesh_file,
    .seeds = [] { return mesh_seeds(".glb"); },
    .words = {"\"mode\":5", "\"count\":", "\"componentType\":5121", "\"byteStride\":", "\"byteOffset\":", "BIN",
        "JSON"},
    .seal = seal,
});

} // namespace glb

namespace gltf {

/// The cube below turned, scaled and mirrored nodes.
std::vector<std::string> seeds() {
    std::vector<std::string> all = mesh_seeds(".gltf");
    std::string scene = all.front();
    const std::string_view plain = R"("nodes":[{"mesh":0}])";
    const std::size_t at = scene.find(plain);
    expect(at != std::string::npos, "one node in a written file");
    scene.replace(at, plain.size(),
        R"("nodes":[{"children":[1,2],"scale":[1,2,3]},{"mesh":0,"rotation":[0,0,1,0]},)"
        R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,-1,0,3,0,0,1]}])");
    all.push_back(scene);
    return all;
}

const Registered target({
    .name = "gltf",
    .file = "input.gltf",
    .use = use_mesh_file,
    .seeds = seeds,
    .words = {"\"nodes\":[", "\"mesh\":0", "\"children\":[0]", "\"matrix\":[", "\"mode\":5", "\"mode\":6",
        "\"count\":", "\"componentType\":5121", "\"byteStride\":", "\"byteOffset\":", "\"normalized\":true",
        "\"sparse\":{}", "\"type\":\"VEC3\"", "null", "[", "{", "}", "]"},
});

} // namespace gltf

namespace meshopt {

/// The decoder's own bytes behind four that say how: mode and filter, stride, count.
void use(const std::filesystem::path& file) {
    using models::meshfile::MeshoptView;
    const std::string bytes = read_file(file, 1U << 20U);
    if (bytes.size() < 4) { throw_error_in(file, "expected a head, got none"); }
    const auto head = [&](std::size_t at) { return std::size_t{static_cast<unsigned char>(bytes[at])}; };
    MeshoptView view;
    view.mode = static_cast<MeshoptView::Mode>(head(0) % 3);
    view.filter = static_cast<MeshoptView::Filter>(head(0) / 3 % 3);
    view.stride = head(1);
    view.count = head(2) + 256 * head(3);
    try {
        const std::string unpacked = models::meshfile::meshopt_unpacked(std::string_view(bytes).substr(4), view);
        expect(unpacked.size() == view.count * view.stride, "as many bytes as asked for");
    } catch (const Error& fault) { throw_error_in(file, fault.what()); }
}

std::vector<std::string> seeds() {
    std::string attributes("\0\4\3\0\xa0", 5);
    for (int k = 0; k < 4; ++k) { attributes += "\3" + std::string(16, '\2'); }
    attributes += std::string(32, '\1');
    return {attributes, std::string("\1\4\6\0\xe1\xf0\0", 7) + std::string(16, '\0'),
        std::string("\2\4\3\0\xd1\x14\5\4\0\0\0\0", 12)};
}

const Registered target({.name = "meshopt", .file = "input.bin", .use = use, .seeds = seeds});

} // namespace meshopt

namespace ysflight {

constexpr const char* surface =
    "SURF\nV 0 0 0\nV 1 0 0 R\nV 1 1 0\nV 0 1 0\nF\nV 0 1 2 3\nN 0 0 0 0 0 1\nC 255 0 9\nE\n"
    "F\nV 0 1 2\nN 0 0 0 0 0 0\nC 31744\nB\nE\nE\nZA 1 120\nZL 1\nE\n";

const Registered surface_target({
    .name = "srf",
    .file = "input.srf",
    .use = use_mesh_file,
    .seeds = [] { return std::vector<std::string>{surface}; },
    .words = {"V ", "F\n", "E\n", "N ", "C ", "B\n", "ZA ", "ZL ", " R\n", "VER ", "FAC\n", "END\n"},
});

const Registered model_target({
    .name = "dnm",
    .file = "input.dnm",
    .use = use_mesh_file,
    .seeds =
        [] {
            return std::vector<std::string>{
                fmt::format("DYNAMODEL\nDNMVER 1\nPCK a.srf 19\n{}SRF \"body\"\nFIL a.srf\nCLA 0\nNST 1\n"
                            "STA 0 0 0 0 0 0 1\nPOS 0 1 0 16384 0 0 1\nCNT 0 1 0\nREL DEP\nNCH 1\nCLD \"prop\"\nEND\n"
                            "SRF \"prop\"\nFIL a.srf\nCLA 3\nNST 0\nPOS 0 0 2 0 0 0 1\nNCH 0\nEND\nEND\n",
                    surface)};
        },
    .words = {"PCK ", "SRF \"", "FIL ", "CLA ", "STA ", "POS ", "CNT ", "CLD \"", "END\n", "a.srf"},
});

} // namespace ysflight

namespace xplane_object {

const Registered target({
    .name = "xplane_object",
    .file = "input.obj",
    .use = use_mesh_file,
    .seeds =
        [] {
            return std::vector<std::string>{
                "I\n800\nOBJ\nTEXTURE none\nPOINT_COUNTS 4 0 0 6\nVT 0 0 0 0 1 0 0 0\nVT 1 0 0 0 1 0 1 0\n"
                "VT 1 0 -1 0 1 0 1 1\nVT 0 0 -1 0 1 0 0 1\nIDX10 0 2 1 0 3 2 0 2 1 0\nIDX 3\nIDX 2\n"
                "ATTR_LOD 0 100\nTRIS 0 6\nANIM_begin\nANIM_trans 0 1 0 0 2 0 0 1 a/b\n"
                "ANIM_rotate_begin 0 0 1 c\nANIM_rotate_key 0 0\nANIM_rotate_key 1 90\nANIM_rotate_end\n"
                "ANIM_rotate 1 0 0 0 45 0 1 d\nANIM_show 0 1 e\nATTR_no_cull\nTRIS 3 3\nANIM_end\n"};
        },
    .words = {"VT ", "IDX ", "IDX10 ", "TRIS ", "ANIM_begin\n", "ANIM_end\n", "ANIM_trans ", "ANIM_rotate ",
        "ANIM_hide ", "ANIM_trans_begin ", "ANIM_trans_key ", "ANIM_trans_end\n", "ATTR_shade_flat\n", "ATTR_LOD "},
});

} // namespace xplane_object

namespace mtl {

void use(const std::filesystem::path& file) {
    for (const models::Material& material : models::polygons::read_mtl(file).materials) {
        expect(!material.name.empty(), "a name");
        for (int part = 0; part < 3; ++part) {
            expect(material.colour[part] >= 0.0F && material.colour[part] <= 1.0F, "0 to 1");
        }
    }
}

const Registered target({
    .name = "mtl",
    .file = "input.mtl",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{"# c\nnewmtl grey\nKd 0.5 0.5 0.5\nKa 1 1 1\nmap_Kd "
                                            "x.png\n\nnewmtl a b\nKd 1 0 1e-3\r\n"
                                            "newmtl plain\n"};
        },
    .words = {"newmtl ", "Kd ", "Kd 0 0 0\n", "newmtl grey\n", "\r\n", "\t"},
});

} // namespace mtl

namespace obj_mesh {

std::vector<std::string> seeds() {
    std::vector<std::string> all = mesh_seeds(".obj");
    all.push_back("# comment\no a\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
                  "f 1/1/1 2/1/1 3//1 4//1\nf -1 -2 -3 -4\nusemtl x\nf 1 2 \\\n 3\ns off\n");
    return all;
}

const Registered target({
    .name = "obj_mesh",
    .file = "input.obj",
    .use = use_mesh_file,
    .seeds = seeds,
    .words = {"v ", "vn ", "f ", "usemtl ", "mtllib ", "\\\n", "1/2/3", "1//1", "-4", "nan"},
});

} // namespace obj_mesh

namespace obj_polygons {

using models::polygons::PolygonModel;

/// Every polygon is planar and convex, and the model is the same when it is written and read again.
void use(const std::filesystem::path& file) {
    const PolygonModel model = models::polygons::read_obj(file);
    const double tolerance_m = models::polygons::flatness_tolerance_m(model);
    for (std::size_t polygon = 0; polygon < model.polygons.size(); ++polygon) {
        expect(model.polygons[polygon].material < model.materials.size(), "a material");
        expect(model.polygons[polygon].part < model.parts.size(), "a part");
        const auto fault = models::polygons::polygon_fault(model, polygon, tolerance_m);
        expect(!fault, "polygons without faults, got: " + fault.value_or(""));
    }
    const std::filesystem::path written = file.parent_path() / "again.obj";
    models::polygons::write_obj(written, model);
    const PolygonModel again = models::polygons::read_obj(written);
    expect(again.vertices_m == model.vertices_m, "the same vertices again");
    expect(again.corner_vertices == model.corner_vertices, "the same polygons again");
    expect(again.pivots.size() == model.pivots.size(), "the same pivots again");
}

std::vector<std::string> seeds() {
    return {
        // A box with an open lid that turns, and a decal.
        "# pivot lid 0 0 1 axis 0 1 0 rpm 30\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 1\nv 2 0 "
        "1\n"
        "v 2 1 1\nv 0 1 1\ng box\nusemtl grey\nf 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
        "f 4 1 5 8\ng lid\nusemtl red\nf 5 6 7 8\n",
        // Dented, bent and with sides that meet; corners of all forms.
        "mtllib none.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nv 0 0 2\nv 4 0 2.5\nv 4 4 "
        "2\n"
        "v 0 4 2.1\nvt 0 0\nvn 0 0 1\no dent\nf 1/1/1 2//1 3/1 4 5\no bent\nf -4 -3 -2 -1\n"
        "f 6 7 \\\n 8\n",
    };
}

const Registered target({
    .name = "obj_polygons",
    .file = "input.obj",
    .use = use,
    .seeds = seeds,
    .words = {"v ", "f ", "g ", "o ", "usemtl ", "mtllib ", "# pivot ", " axis ", " rpm ", "\\\n", "-1", "1/2/3", "//",
        "bzp", "f 1 2 3 4 5 6 7 8\n"},
});

} // namespace obj_polygons

namespace ply {

constexpr const char* ascii = "ply\nformat ascii 1.0\ncomment c\nelement vertex 5\nproperty float x\nproperty float y\n"
                              "property double z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                              "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                              "property list uchar int extra\nelement face 3\nproperty list uchar int vertex_indices\n"
                              "property int flags\nelement edge 1\nproperty int a\nend_header\n"
                              "0 0 0 0 0 1 255 0 1 0\n1 0 0 0 0 1 3 4 5 2 1 2\n1 1 0 0 0 1 3 4 5 0\n"
                              "0 1 0 0 1 0 9 9 9 0\n0.5 0.5 1 0 0 1 3 4 5 0\n4 0 3 2 1 7\n3 0 1 4 8\n3 1 2 4 9\n5\n";

std::string big_endian() {
    return "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty uchar x\n"
           "property uchar y\nproperty uchar z\nelement face 2\n"
           "property list ushort uint vertex_indices\nend_header\n" +
           std::string("\0\0\0\1\0\0\1\1\0\0\1\0", 12) +
           std::string("\0\3\0\0\0\0\0\0\0\1\0\0\0\2\0\3\0\0\0\0\0\0\0\2\0\0\0\3", 28);
}

std::vector<std::string> seeds() {
    std::vector<std::string> all = mesh_seeds(".ply");
    all.insert(all.end(), {ascii, big_endian()});
    return all;
}

const Registered target({
    .name = "ply",
    .file = "input.ply",
    .use = use_mesh_file,
    .seeds = seeds,
    .words = {"element ", "vertex ", "face ", "property ", "list ", "uchar ", "float ", "double ", "int ", "ushort ",
        "vertex_indices\n", "end_header\n", "binary_big_endian", "comment "},
});

} // namespace ply

namespace progressive {

namespace refine = visuals::refine;

/// A square of hills with a boundary, 81 vertices.
models::TriangleMesh hills() {
    constexpr std::uint32_t side = 9;
    models::TriangleMesh mesh;
    mesh.name = "hills";
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const double x_m = i % side;
        const double y_m = i / side;
        mesh.vertices_m.emplace_back(x_m, y_m, std::sin(x_m) * std::cos(1.7 * y_m));
        mesh.colours.emplace_back(0.1F, 0.1F * static_cast<float>(i % side), 0.5F);
        if (i % side + 1 < side && i / side + 1 < side) {
            mesh.triangles.push_back({i, i + 1, i + side});
            mesh.triangles.push_back({i + 1, i + side + 1, i + side});
        }
    }
    return mesh;
}

std::string progressive_bytes(const models::TriangleMesh& mesh) {
    models::simplify::SimplifyOptions options;
    const refine::ProgressiveMesh made(models::simplify::fast_sequence(mesh, options));
    return bytes_written("seed.pm", [&](const auto& file) { refine::write_progressive(file, made); });
}

std::vector<std::string> seeds() { return {progressive_bytes(coloured_cube()), progressive_bytes(hills())}; }

/// The checksum of each block that fits, and the file's length in the first one.
void seal(std::string& bytes) {
    constexpr std::size_t length_at = 4;
    std::size_t at = refine::progressive_signature.size();
    for (bool first = true; at + refine::block_header_bytes <= bytes.size(); first = false) {
        std::uint32_t count = 0;
        std::memcpy(&count, bytes.data() + at, sizeof count);
        if (count > bytes.size() - at - refine::block_header_bytes) { return; }
        char* const block = bytes.data() + at + sizeof count;
        const std::uint64_t length = bytes.size();
        if (first && count >= length_at + sizeof length) { std::memcpy(block + length_at, &length, sizeof length); }
        Hash hash;
        hash.add(std::as_bytes(std::span(block, count)));
        const std::uint64_t value = hash.value();
        std::memcpy(block + count, &value, sizeof value);
        at += refine::block_header_bytes + count;
    }
}

/// Refines all of it, and takes it back as far as that goes.
void use(const std::filesystem::path& file) {
    const auto mesh = std::make_shared<const refine::ProgressiveMesh>(refine::read_progressive(file));
    refine::SelectiveRefiner refiner(mesh);
    const std::vector<std::uint32_t> nodes = mesh->coarsest_first();
    for (const std::uint32_t node : nodes) { refiner.split(node); }
    expect(refiner.active_count() == mesh->leaf_count(), "all leaves active");
    expect(refiner.face_count() == mesh->face_count(), "all faces there");
    if (refiner.face_count() > 0) { use_mesh(refine::active_mesh(refiner).mesh); }
    refiner.repair();
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) { refiner.collapse(*node); }
}

const Registered target({.name = "progressive", .file = "input.pm", .use = use, .seeds = seeds, .seal = seal});

} // namespace progressive

namespace stl {

std::vector<std::string> seeds() {
    std::vector<std::string> all = mesh_seeds(".stl");
    all.push_back("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                  "vertex 0 1e-1 0\nendloop\nendfacet\nfacet normal 0 0 0\nouter loop\n"
                  "vertex 0 0 0\nvertex 1 0 0\nvertex 0 0 -1\nendloop\nendfacet\nendsolid a\n");
    return all;
}

const Registered target({
    .name = "stl",
    .file = "input.stl",
    .use = use_mesh_file,
    .seeds = seeds,
    .words = {"solid ", "facet normal ", "outer loop\n", "vertex ", "endloop\n", "endfacet\n", "endsolid"},
});

} // namespace stl

namespace vrml {

constexpr const char* scene =
    "PROTO P [ ] { Group { } }\nDEF hull Group { }\nTransform { rotation 0 1 0 1.5 scale 1 2 -1 "
    "translation 4 0 0\n"
    " children [ # comment\n Shape { geometry IndexedFaceSet { ccw FALSE\n"
    "coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0, 1 1 0, 0 0 1, 1 0 1, 0 1 1, 1 1 1 ] } color "
    "Color { color [ 1 0 0, 0 1 0 ] } colorIndex [ 0 1 ]\n"
    "colorPerVertex FALSE coordIndex [ 0 1 3 2 -1 4 5 7 6 -1 ] } } ] }\n"
    "Switch { whichChoice 0 choice [ USE hull ] }\n";

std::vector<std::string> seeds() {
    std::vector<std::string> all = mesh_seeds(".wrl");
    all.push_back(all.front() + scene);
    return all;
}

const Registered target({
    .name = "vrml",
    .file = "input.wrl",
    .use = use_mesh_file,
    .seeds = seeds,
    .words = {"Transform { ", "Shape { ", "IndexedFaceSet { ", "DEF ", "USE ", "coordIndex [ ", "-1 ", "[ ", "] ", "{ ",
        "} ", "children [ ", "PROTO ", "#", "TRUE ", "Switch { "},
});

} // namespace vrml

} // namespace

} // namespace octant::tests::formats
