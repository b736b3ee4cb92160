#pragma once

#include "models/simplify/candidate.h"
#include "models/simplify/edge_splits.h"
#include "models/simplify/simplify_options.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <functional>

namespace octant::models::simplify {

/// How a result is revised.
struct Revision {
    SplitBy split_by = SplitBy::Peaks;
    std::size_t splits = 1;               ///< The number of edges that are split.
    Chooser chooser = Chooser::Distances; ///< What chooses the collapses.
};

/// Splits edges of a result where it is farthest off and collapses the cheapest ones until the goal
/// is met again, then polishes.
using Revise = std::function<TriangleMesh(
    const TriangleMesh& mesh,
    const TriangleMesh& original,
    const SimplifyOptions& options,
    const Revision& revision)>;

/// Tries to improve a result, which has the original given, by revisions, side by side, as long as
/// one of them is better and turns no more over than most_turned. It is given up where the first
/// time leaves more badness than given.
Candidate revised(
    Candidate best,
    const Yardstick& yardstick,
    double most_badness,
    const measure::TargetSurface& original,
    const SimplifyOptions& options,
    const Revise& revise);

} // namespace octant::models::simplify
