#include "models/meshfile/mesh_file.h"
#include "tests/fuzz/formats/mesh_use.h"
#include "tests/fuzz/formats/target.h"

namespace octant::tests::formats::ac3d_format {

namespace {

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
    .use = [](const auto& file) { use_mesh(models::meshfile::read_mesh(file)); },
    .seeds = seeds,
    .words = {"OBJECT ", "poly\n", "group\n", "kids ", "numvert ", "numsurf ", "SURF 0x", "mat ", "refs ", "data ",
        "rot ", "loc ", "MATERIAL "},
});

} // namespace

} // namespace octant::tests::formats::ac3d_format
