#pragma once

#include "visuals/refine/refine_criterion.h"
#include "visuals/refine/selective_refiner.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace octant::visuals::refine {

/// A region in which the mesh is to be refined.
struct Sphere {
    glm::dvec3 centre_m{0.0}; ///< In the mesh's own axes.
    double radius_m = 0.0;
};

/// Splits until every original vertex inside one of the spheres is active, as in the paper's example of the cow whose
/// chest alone is refined. Returns how many splits that requests: the inner nodes that have such a vertex below them;
/// splits forced by the rule are not counted. Does not call repair().
std::size_t refine_regions(SelectiveRefiner& refiner, std::span<const Sphere> regions);

/// Splits until every original vertex below a node is active. Returns the requested splits as refine_regions does.
std::size_t refine_subtree(SelectiveRefiner& refiner, std::uint32_t node);

/// Splits every inner node whose projected error exceeds `error_px`. Returns how many these are. Does not call
/// repair().
std::size_t refine_for_view(
    SelectiveRefiner& refiner, const RefineView& view, double error_px, const CriterionOptions& options = {});

} // namespace octant::visuals::refine
