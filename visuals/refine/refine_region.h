#pragma once

#include "visuals/refine/refine_criterion.h"
#include "visuals/refine/selective_refiner.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace octant::visuals::refine {

struct Sphere {
    glm::dvec3 centre_m{0.0}; ///< in the mesh's own axes
    double radius_m = 0.0;
};

/// Splits until every original vertex in one of the spheres is active. Returns how
/// many splits of the base mesh that takes by itself: inner nodes with such a vertex below. Without
/// repair().
std::size_t refine_regions(SelectiveRefiner& refiner, std::span<const Sphere> regions);

/// The same for all vertices below a node.
std::size_t refine_below(SelectiveRefiner& refiner, std::uint32_t node);

/// Splits every node that shows an error above `error_px`. Returns how many these
/// are. Without repair().
std::size_t refine_for_view(
    SelectiveRefiner& refiner,
    const RefineView& view,
    double error_px,
    const CriterionOptions& options = {});

} // namespace octant::visuals::refine
