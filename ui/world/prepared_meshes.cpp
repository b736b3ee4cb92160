#include "ui/world/prepared_meshes.h"

#include "sim/base/error.h"
#include "sim/base/file_status.h"
#include "sim/base/hash.h"
#include "visuals/refine/progressive_file.h"

#include <cstdint>
#include <fmt/format.h>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::world {

namespace fs = std::filesystem;
namespace refine = visuals::refine;

namespace {

template <class Item>
void add_list(Hash& hash, const std::vector<Item>& list) {
    hash.add_word(list.size());
    hash.add(std::as_bytes(std::span(list)));
}

/// Another number for each seed.
std::uint64_t hash_of(const models::TriangleMesh& mesh, std::uint64_t seed) {
    Hash hash;
    hash.add_word(seed);
    hash.add_word(prepared_version);
    add_list(hash, mesh.vertices_m);
    add_list(hash, mesh.colours);
    add_list(hash, mesh.triangles);
    add_list(hash, mesh.normals);
    add_list(hash, mesh.corner_normals);
    add_list(hash, mesh.triangle_materials);
    for (const models::Material& material : mesh.materials) {
        hash.add(std::as_bytes(std::span(&material.colour, 1)));
    }
    return hash.value();
}

/// Nothing, and a note where there is a file, when it cannot be used.
std::shared_ptr<const refine::ProgressiveMesh>
kept_mesh(const fs::path& file, std::vector<std::string>& notes) {
    if (!is_there(file)) {
        return nullptr;
    }
    try {
        auto mesh = std::make_shared<const refine::ProgressiveMesh>(refine::read_progressive(file));
        if (!mesh->parts().notes.empty()) {
            error_in(file, "expected a whole file, got one that was cut off");
        }
        return mesh;
    } catch (const Error& fault) {
        notes.push_back(fmt::format("order cache {}: made anew", fault.what()));
        return nullptr;
    }
}

} // namespace

fs::path prepared_file(const fs::path& folder, const models::TriangleMesh& mesh) {
    return folder / fmt::format("{:016x}{:016x}.pm", hash_of(mesh, 1), hash_of(mesh, 2));
}

RefineMesh
prepared_refine_mesh(const fs::path& folder, const RefineInput& input, models::TriangleMesh mesh) {
    const fs::path file = prepared_file(folder, mesh);
    std::vector<std::string> notes;
    if (auto kept = kept_mesh(file, notes)) {
        return {std::move(kept), std::move(mesh.notes)};
    }
    RefineMesh made = made_refine_mesh(input, std::move(mesh));
    try {
        refine::write_progressive(file, *made.mesh);
    } catch (const Error& fault) {
        notes.push_back(fmt::format("order cache {}: not kept", fault.what()));
    }
    made.notes.insert(made.notes.end(), notes.begin(), notes.end());
    return made;
}

} // namespace octant::ui::world
