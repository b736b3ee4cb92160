#include "models/meshfile/mesh_file.h"
#include "tests/fuzz/formats/mesh_use.h"
#include "tests/fuzz/formats/target.h"

namespace octant::tests::formats::vrml_format {

namespace {

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
    .use = [](const auto& file) { use_mesh(models::meshfile::read_mesh(file)); },
    .seeds = seeds,
    .words = {"Transform { ", "Shape { ", "IndexedFaceSet { ", "DEF ", "USE ", "coordIndex [ ", "-1 ", "[ ", "] ", "{ ",
        "} ", "children [ ", "PROTO ", "#", "TRUE ", "Switch { "},
});

} // namespace

} // namespace octant::tests::formats::vrml_format
