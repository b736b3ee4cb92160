// Refinement of a fresh front in one go: J. Kim, S. Lee, "Truly Selective Refinement of Progressive Meshes", Graphics
// Interface 2001, section 4. Which nodes must split is known beforehand, so all are handed to split_all at once, which
// chooses an order of its own.
#include "visuals/refine/refine_region.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <vector>

namespace octant::visuals::refine {

namespace {

/// Splits all ancestors of the marked nodes, so that these become active. `marked` has one flag for each node and is
/// changed.
std::size_t refine_above(SelectiveRefiner& refiner, std::vector<bool>& marked) {
    const ProgressiveMesh& mesh = refiner.mesh();
    for (std::uint32_t node = 0; node < mesh.node_count(); ++node) {
        const std::uint32_t parent = mesh.parent(node);
        if (marked[node] && parent != none) { marked[parent] = true; }
    }
    std::vector<std::uint32_t> wanted;
    for (auto node = static_cast<std::uint32_t>(mesh.node_count()); node-- > mesh.leaf_count();) {
        if (marked[node]) { wanted.push_back(node); }
    }
    refiner.split_all(wanted);
    return wanted.size();
}

} // namespace

std::size_t refine_regions(SelectiveRefiner& refiner, std::span<const Sphere> regions) {
    const ProgressiveMesh& mesh = refiner.mesh();
    std::vector<bool> marked(mesh.node_count(), false);
    for (std::uint32_t leaf = 0; leaf < mesh.leaf_count(); ++leaf) {
        const glm::dvec3 at_m = glm::dvec3(mesh.position_m(leaf)) + mesh.parts().origin_m;
        marked[leaf] = std::ranges::any_of(
            regions, [&](const Sphere& region) { return glm::distance(at_m, region.centre_m) <= region.radius_m; });
    }
    return refine_above(refiner, marked);
}

std::size_t refine_subtree(SelectiveRefiner& refiner, std::uint32_t node) {
    const ProgressiveMesh& mesh = refiner.mesh();
    std::vector<bool> marked(mesh.node_count(), false);
    marked[node] = true;
    for (std::uint32_t below = node; below >= mesh.leaf_count(); --below) {
        if (marked[below]) {
            marked[mesh.split_of(below).first] = true;
            marked[mesh.split_of(below).second] = true;
        }
    }
    return refine_above(refiner, marked);
}

std::size_t refine_for_view(
    SelectiveRefiner& refiner, const RefineView& view, double error_px, const CriterionOptions& options) {
    const ProgressiveMesh& mesh = refiner.mesh();
    std::vector<std::uint32_t> wanted;
    for (auto node = static_cast<std::uint32_t>(mesh.node_count()); node-- > mesh.leaf_count();) {
        if (projected_error_px(mesh, node, view, options) > error_px) { wanted.push_back(node); }
    }
    refiner.split_all(wanted);
    return wanted.size();
}

} // namespace octant::visuals::refine
