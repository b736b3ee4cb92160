#include "ui/world/refine_mesh.h"

#include "models/repair/repair.h"
#include "models/simplify/simplify.h"
#include "sim/base/error.h"
#include "ui/base/progress.h"
#include "ui/world/mesh_loader.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/refine/progressive_mesh.h"

#include <fmt/format.h>
#include <utility>

namespace octant::ui::world {

namespace refine = visuals::refine;

namespace {

/// Colours are vertices' in a hierarchy: those of the materials around each, where it has none.
void colour_by_materials(models::TriangleMesh& mesh) {
    if (!mesh.colours.empty()) { return; }
    std::vector<glm::vec3> sums(mesh.vertices_m.size(), glm::vec3(0.0F));
    std::vector<int> counts(mesh.vertices_m.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::vec3 colour = models::material_colour(mesh, t);
        for (const std::uint32_t vertex : mesh.triangles[t]) {
            sums[vertex] += colour;
            ++counts[vertex];
        }
    }
    for (std::size_t v = 0; v < sums.size(); ++v) {
        mesh.colours.push_back(counts[v] > 0 ? sums[v] / static_cast<float>(counts[v]) : models::Material().colour);
    }
}

/// Whether a hierarchy has the colour of a mesh without materials everywhere, as one has that was saved of a mesh
/// without colours.
bool is_all_grey(const refine::ProgressiveMesh& mesh) {
    const refine::PackedColour grey = refine::packed_rgb16(models::Material().colour);
    for (std::uint32_t leaf = 0; leaf < mesh.leaf_count(); ++leaf) {
        if (refine::unpacked(mesh.packed_colour(leaf)) != refine::unpacked(grey)) { return false; }
    }
    return mesh.has_colours();
}

void refuse_too_many(const std::string& file, const models::TriangleMesh& mesh) {
    using refine::ProgressiveMesh;
    if (mesh.triangles.size() > ProgressiveMesh::max_faces || mesh.vertices_m.size() > ProgressiveMesh::max_leaves) {
        throw_error_in(file, fmt::format("expected at most {} triangles and {} vertices to refine, got {} and {} "
                                         "(octant simplify makes fewer of them)",
                                 ProgressiveMesh::max_faces, ProgressiveMesh::max_leaves, mesh.triangles.size(),
                                 mesh.vertices_m.size()));
    }
}

} // namespace

void note_repairs(const RefineMeshOptions& input, RefineMesh& mesh) {
    for (const std::string& line : mesh.repairs) { mesh.notes.push_back(input.file + ": " + line); }
}

RefineMesh make_refine_mesh(const RefineMeshOptions& input, models::TriangleMesh mesh) {
    models::repair::RepairedMesh repaired = models::repair::repaired(std::move(mesh));
    RefineMesh result;
    result.notes = repaired.mesh.notes;
    result.repairs = models::repair::describe_counts(repaired.counts);
    note_repairs(input, result);
    if (repaired.mesh.triangles.empty()) { throw_error_in(input.file, "expected a mesh with triangles, got none"); }
    refuse_too_many(input.file, repaired.mesh);
    result.has_material_colours = repaired.mesh.colours.empty();
    colour_by_materials(repaired.mesh);
    constexpr int steps = 1000;
    base::Progress progress("collapsing edges", steps, input.quiet, "thousandths");
    models::simplify::SimplifyOptions options;
    options.length_share = 0.03;
    if (input.base > 0) { options.goal.vertices = input.base; }
    options.show_progress = [&](double share) { progress.show(static_cast<int>(share * steps)); };
    const models::CollapseSequence sequence = models::simplify::fast_sequence(std::move(repaired.mesh), options);
    progress.finish();
    result.mesh = std::make_shared<const refine::ProgressiveMesh>(sequence);
    return result;
}

RefineMesh read_refine_mesh(const RefineMeshOptions& input) {
    RefineMesh result;
    if (refine::is_progressive_file(input.file)) {
        result.mesh =
            std::make_shared<const refine::ProgressiveMesh>(refine::read_progressive(input.file, input.max_vertices));
        if (result.mesh->face_count() == 0) { throw_error_in(input.file, "expected a mesh with triangles, got none"); }
        result.notes = result.mesh->parts().notes;
        result.has_material_colours = is_all_grey(*result.mesh);
    } else {
        result = make_refine_mesh(input, load_mesh(input.file, {.pictures = true, .backs = true}));
    }
    return result;
}

RefineMesh load_refine_mesh(const RefineMeshOptions& input) {
    RefineMesh result = read_refine_mesh(input);
    for (const std::string& note : result.notes) { base::print_note(input.quiet, "note: " + note); }
    return result;
}

} // namespace octant::ui::world
