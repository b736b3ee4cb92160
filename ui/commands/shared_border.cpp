#include "ui/commands/shared_border.h"

#include "models/meshfile/mesh_join.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/world/mesh_loader.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <set>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace octant::ui::commands {

namespace meshfile = models::meshfile;
namespace simplify = models::simplify;

namespace {

/// Vertices that triangles of several files share, by pairs of files.
using SharedVertices = std::map<std::pair<std::size_t, std::size_t>, std::vector<std::uint32_t>>;

/// `materials`: the material of each triangle; those of file i begin at first_materials[i].
SharedVertices shared_vertices(const models::TriangleMesh& mesh, const std::vector<std::uint32_t>& materials,
    const std::vector<std::uint32_t>& first_materials) {
    std::vector<std::set<std::size_t>> files(mesh.vertices_m.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto next = std::ranges::upper_bound(first_materials, materials[t]);
        for (const std::uint32_t vertex : mesh.triangles[t]) {
            files[vertex].insert(static_cast<std::size_t>(next - first_materials.begin()) - 1);
        }
    }
    SharedVertices shared;
    for (std::uint32_t vertex = 0; vertex < files.size(); ++vertex) {
        for (const std::size_t one : files[vertex]) {
            for (const std::size_t other : files[vertex]) {
                if (one < other) { shared[{one, other}].push_back(vertex); }
            }
        }
    }
    return shared;
}

/// Where all common vertices of two files have one coordinate in common, as on the straight border of two map tiles,
/// sets that coordinate for their common vertices in the simplified mesh. A vertex that stands at the place of an
/// original vertex is not moved: it is locked.
void align_border(models::TriangleMesh& made, const SharedVertices& made_shared, const models::TriangleMesh& original,
    const SharedVertices& original_shared) {
    std::set<std::array<double, 3>> others;
    for (const glm::dvec3& at_m : original.vertices_m) { others.insert({at_m.x, at_m.y, at_m.z}); }
    const auto is_free = [&](std::uint32_t vertex) {
        const glm::dvec3& at_m = made.vertices_m[vertex];
        return !others.contains({at_m.x, at_m.y, at_m.z});
    };
    for (const auto& [files, vertices] : made_shared) {
        const auto before = original_shared.find(files);
        for (int axis = 0; axis < 3 && before != original_shared.end(); ++axis) {
            const double at = original.vertices_m[before->second.front()][axis];
            const bool is_straight = std::ranges::all_of(
                before->second, [&](std::uint32_t vertex) { return original.vertices_m[vertex][axis] == at; });
            for (const std::uint32_t vertex : is_straight ? vertices : std::vector<std::uint32_t>()) {
                double& coordinate = made.vertices_m[vertex][axis];
                coordinate = is_free(vertex) ? at : coordinate;
            }
        }
    }
}

} // namespace

models::TriangleMesh SharedBorderFile::part_of(const models::TriangleMesh& joined) const {
    models::TriangleMesh part = meshfile::part_of_materials(joined, first_material, materials);
    if (!has_materials) {
        part.materials.clear();
        part.triangle_materials.clear();
    }
    if (!has_colours) { part.colours.clear(); }
    return part;
}

models::TriangleMesh read_joined(const std::vector<std::string>& names, std::vector<SharedBorderFile>& files) {
    models::TriangleMesh joined;
    for (const std::string& name : names) {
        models::TriangleMesh mesh = world::load_mesh(name);
        files.push_back({.first_material = static_cast<std::uint32_t>(joined.materials.size()),
            .has_materials = !mesh.materials.empty(),
            .has_colours = !mesh.colours.empty()});
        meshfile::join_mesh(joined, std::move(mesh), {});
        files.back().materials = static_cast<std::uint32_t>(joined.materials.size()) - files.back().first_material;
    }
    return joined;
}

std::optional<std::size_t> vanished_file(const std::vector<SharedBorderFile>& files,
    const std::vector<std::uint32_t>& original_materials, const std::vector<std::uint32_t>& made_materials) {
    for (std::size_t i = 0; i < files.size(); ++i) {
        const auto is_of_file = [&](std::uint32_t material) {
            return material >= files[i].first_material && material < files[i].first_material + files[i].materials;
        };
        if (std::ranges::any_of(original_materials, is_of_file) && std::ranges::none_of(made_materials, is_of_file)) {
            return i;
        }
    }
    return std::nullopt;
}

bool align_shared_borders(const simplify::AttributeSeams& seams, const std::vector<SharedBorderFile>& files,
    const models::TriangleMesh& original, models::TriangleMesh& made) {
    std::vector<std::uint32_t> first_materials;
    std::ranges::transform(files, std::back_inserter(first_materials), &SharedBorderFile::first_material);
    const SharedVertices shared = shared_vertices(seams.marked(), original.triangle_materials, first_materials);
    align_border(made, shared_vertices(made, seams.with_colours(made).triangle_materials, first_materials),
        seams.marked(), shared);
    return !shared.empty();
}

UnfinishedFolder::UnfinishedFolder(const std::filesystem::path& parent)
    : parent_(parent), path_(parent / fmt::format(".octant-{}.part", ::getpid())) {
    make_folder(path_);
}

UnfinishedFolder::~UnfinishedFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

void UnfinishedFolder::move_into_place() const {
    std::vector<std::filesystem::path> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
        names.push_back(entry.path().filename());
        check_can_write(parent_ / names.back());
    }
    for (const std::filesystem::path& name : names) {
        std::error_code code;
        std::filesystem::rename(path_ / name, parent_ / name, code);
        if (code) { throw_error_in(parent_ / name, "cannot be written: " + code.message()); }
    }
}

} // namespace octant::ui::commands
