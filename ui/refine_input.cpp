#include "ui/refine_input.h"

#include "models/meshfile/mesh_file.h"
#include "models/meshfile/repair.h"
#include "models/simplify/simplify.h"
#include "sim/base/error.h"
#include "ui/progress.h"
#include "visuals/refine/progressive_file.h"

namespace octant::ui {

namespace refine = visuals::refine;

namespace {

refine::ProgressiveMesh made_hierarchy(const RefineInput& input) {
    models::meshfile::RepairedMesh repaired =
        models::meshfile::repaired(models::meshfile::read_mesh(input.file));
    for (const std::string& note : repaired.mesh.notes) {
        say(input.quiet, "note: " + note);
    }
    for (const std::string& note : models::meshfile::in_words(repaired.counts)) {
        say(input.quiet, "note: " + note);
    }
    if (repaired.mesh.triangles.empty()) {
        error_in(input.file, "expected a mesh with triangles, got none");
    }
    constexpr int steps = 1000;
    Progress progress("collapsing edges", steps, input.quiet, "thousandths");
    models::simplify::SimplifyOptions options;
    options.quality = models::simplify::Quality::Fast;
    if (input.base > 0) {
        options.goal.vertices = input.base;
    }
    options.show_progress = [&](double share) { progress.show(static_cast<int>(share * steps)); };
    const models::simplify::Simplified simplified =
        models::simplify::simplified(std::move(repaired.mesh), options);
    progress.finish();
    return refine::ProgressiveMesh(simplified.sequence);
}

} // namespace

std::shared_ptr<const refine::ProgressiveMesh> read_refine_input(const RefineInput& input) {
    if (!refine::is_progressive_file(input.file)) {
        return std::make_shared<const refine::ProgressiveMesh>(made_hierarchy(input));
    }
    refine::ProgressiveMesh mesh = refine::read_progressive(input.file, input.most_vertices);
    for (const std::string& note : mesh.parts().notes) {
        say(input.quiet, "note: " + note);
    }
    return std::make_shared<const refine::ProgressiveMesh>(std::move(mesh));
}

} // namespace octant::ui
