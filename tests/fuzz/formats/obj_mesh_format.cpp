#include "models/meshfile/mesh_file.h"
#include "tests/fuzz/formats/mesh_use.h"
#include "tests/fuzz/formats/target.h"

namespace octant::tests::formats::obj_mesh_format {

namespace {

std::vector<std::string> seeds() {
    std::vector<std::string> all = mesh_seeds(".obj");
    all.push_back("# comment\no a\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
                  "f 1/1/1 2/1/1 3//1 4//1\nf -1 -2 -3 -4\nusemtl x\nf 1 2 \\\n 3\ns off\n");
    return all;
}

const Registered target({
    .name = "obj_mesh",
    .file = "input.obj",
    .use = [](const auto& file) { use_mesh(models::meshfile::read_mesh(file)); },
    .seeds = seeds,
    .words = {"v ", "vn ", "f ", "usemtl ", "mtllib ", "\\\n", "1/2/3", "1//1", "-4", "nan"},
});

} // namespace

} // namespace octant::tests::formats::obj_mesh_format
