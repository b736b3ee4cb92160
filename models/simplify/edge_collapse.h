#pragma once

#include "models/simplify/collapsing_surface.h"
#include "models/simplify/local_error.h"
#include "models/simplify/simplify_options.h"
#include "models/simplify/surface_samples.h"

#include <cstddef>

namespace octant::models::simplify {

/// Collapses edges, the cheapest first by quadrics, until the goal is met or no edge can collapse.
void collapse_by_quadrics(
    CollapsingSurface& collapsing, const Goal& goal, const SimplifyOptions& options);

/// The same, the cheapest first by the growth of the error against samples of the original. Each
/// sample must be in the list of a triangle that is near. Holes are closed, handles cut and shells
/// dropped where that is cheaper, unless the options keep them. For a wanted error only holes are
/// closed, as a record of collapses cannot hold the rest. Returns how many shells were dropped.
std::size_t collapse_by_samples(
    CollapsingSurface& collapsing,
    SurfaceSamples& samples,
    const OriginalSurface& original,
    const Goal& goal,
    const SimplifyOptions& options);

} // namespace octant::models::simplify
