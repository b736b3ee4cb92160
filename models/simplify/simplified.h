#pragma once

#include "models/collapse_sequence.h"
#include "models/simplify/simplify_options.h"
#include "models/triangle_mesh.h"

#include <cstddef>

namespace octant::models::simplify {

/// The result of a simplification.
struct Simplified {
    TriangleMesh mesh; ///< The mesh after the polish, with the original's materials and normals.
    /// The collapses that led to it, without the polish and the revisions.
    CollapseSequence sequence;
    /// Shells that had to go for the goal, the smallest ones; the sequence begins without them.
    std::size_t shells_gone = 0;
    /// What chose the collapses: of those that were tried the one with the best result.
    Chooser chosen_by = Chooser::Distances;
};

} // namespace octant::models::simplify
