#pragma once

#include "ui/report/table.h"
#include "visuals/refine/progressive_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cstdint>
#include <ctime>
#include <memory>
#include <span>

namespace octant::ui::studies::refinement {

using RefinedModel = std::shared_ptr<const visuals::refine::ProgressiveMesh>;

/// Splits that each rule forces, percent of those requested; faces turned over without repair and what repair costs.
/// One base vertex after another, and spheres of shares of the diagonal.
report::ResultTable forced_splits_table(std::span<const RefinedModel> models);

/// Operations a second on one core and memory.
report::ResultTable refinement_speed_table(std::span<const RefinedModel> models);

/// A view that goes around each model and nearer and back: operations a frame, steps of vertices.
report::ResultTable refinement_path_table(std::span<const RefinedModel> models, int frames);

/// Bounding sphere of the leaves of a hierarchy, in file axes.
struct BoundingSphere {
    glm::dvec3 centre_m{0.0};
    double reach_m = 0.0; ///< to the farthest vertex
};

inline BoundingSphere bounding_sphere(const visuals::refine::ProgressiveMesh& mesh) {
    glm::dvec3 min_m(mesh.position_m(0));
    glm::dvec3 max_m = min_m;
    for (std::uint32_t leaf = 1; leaf < mesh.leaf_count(); ++leaf) {
        min_m = glm::min(min_m, glm::dvec3(mesh.position_m(leaf)));
        max_m = glm::max(max_m, glm::dvec3(mesh.position_m(leaf)));
    }
    return {0.5 * (min_m + max_m) + mesh.parts().origin_m, 0.5 * glm::distance(min_m, max_m)};
}

/// Processor time of this program so far.
inline double process_cpu_time_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

} // namespace octant::ui::studies::refinement
