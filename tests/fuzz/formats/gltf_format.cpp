#include "models/meshfile/mesh_file.h"
#include "tests/fuzz/formats/mesh_use.h"
#include "tests/fuzz/formats/target.h"

namespace octant::tests::formats::gltf_format {

namespace {

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
    .use = [](const auto& file) { use_mesh(models::meshfile::read_mesh(file)); },
    .seeds = seeds,
    .words = {"\"nodes\":[", "\"mesh\":0", "\"children\":[0]", "\"matrix\":[", "\"mode\":5", "\"mode\":6",
        "\"count\":", "\"componentType\":5121", "\"byteStride\":", "\"byteOffset\":", "\"normalized\":true",
        "\"sparse\":{}", "\"type\":\"VEC3\"", "null", "[", "{", "}", "]"},
});

} // namespace

} // namespace octant::tests::formats::gltf_format
