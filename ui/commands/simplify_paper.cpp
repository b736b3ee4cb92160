#include "ui/commands/simplify_paper.h"

#include "models/measure/mesh_defects.h"

#include <fmt/format.h>
#include <string>

namespace octant::ui::commands {

namespace {

std::string reading_of(const models::simplify::PaperOptions& options) {
    const std::string distances = options.colour_weight > 0.0
                                      ? fmt::format("squared, in position and {:.3g} x colour", options.colour_weight)
                                      : "squared, in position";
    return fmt::format("shortest edge first; the better of both ends and the middle; faces of either end once; "
                       "distances {}; a foot is inside for 0 < a, b, c < 1; vertices of no face are counted",
        distances);
}

} // namespace

void add_paper_results(base::JsonValue& results, const models::simplify::PaperOptions& options,
    const models::simplify::PaperResult& result) {
    results["reading"] = reading_of(options);
    results["contractions"] = result.contractions;
    results["counted_vertices"] = result.counted_vertices;
    results["feet"] = result.feet;
    results["feet_outside"] = result.feet_outside;
    if (result.feet > 0) { // the plane's measure has none
        results["share_outside"] = static_cast<double>(result.feet_outside) / static_cast<double>(result.feet);
    }
    results["error_sum_plane"] = result.sums.plane_m2;
    results["error_sum_triangle"] = result.sums.triangle_m2;
    results["error_sum_bidirectional"] = result.sums.bidirectional_m2;
    const models::measure::MeshDefects defects = models::measure::defects(result.mesh);
    results["duplicate_faces"] = defects.duplicate_faces;
    results["non_manifold_edges"] = defects.non_manifold_edges;
}

} // namespace octant::ui::commands
