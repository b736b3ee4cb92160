#include "models/meshfile/mesh_file.h"
#include "tests/fuzz/formats/mesh_use.h"
#include "tests/fuzz/formats/target.h"

namespace octant::tests::formats::ply_format {

namespace {

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
    .use = [](const auto& file) { use_mesh(models::meshfile::read_mesh(file)); },
    .seeds = seeds,
    .words = {"element ", "vertex ", "face ", "property ", "list ", "uchar ", "float ", "double ", "int ", "ushort ",
        "vertex_indices\n", "end_header\n", "binary_big_endian", "comment "},
});

} // namespace

} // namespace octant::tests::formats::ply_format
