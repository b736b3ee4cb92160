#include "models/meshfile/mesh_file.h"
#include "tests/fuzz/formats/mesh_use.h"
#include "tests/fuzz/formats/target.h"

namespace octant::tests::formats::stl_format {

namespace {

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
    .use = [](const auto& file) { use_mesh(models::meshfile::read_mesh(file)); },
    .seeds = seeds,
    .words = {"solid ", "facet normal ", "outer loop\n", "vertex ", "endloop\n", "endfacet\n", "endsolid"},
});

} // namespace

} // namespace octant::tests::formats::stl_format
