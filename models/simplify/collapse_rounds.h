#pragma once

#include "models/simplify/collapse_guard.h"
#include "models/simplify/collapsing_surface.h"

#include <cstddef>

namespace octant::models::simplify {

/// How rounds of collapses go.
struct RoundOptions {
    std::size_t faces = 0; ///< They end here at the latest.
    Strictness strictness = Strictness::Loose;
    bool low_may_turn = true; ///< As in SimplifyOptions.
    int threads = 1;          ///< The number of threads; it does not change the result.
};

/// Collapses edges by their quadrics in rounds, each of them all over the surface, until few
/// triangles are left or rounds get nowhere. Meant for the beginning of a long way: the errors made
/// there are far below those at its end, so that it does not matter which of many cheap collapses
/// comes first. It takes a third of the time of CollapseRun, as it goes through memory in order and
/// keeps no queue. Compacts the surface.
void collapse_in_rounds(CollapsingSurface& collapsing, const RoundOptions& options);

} // namespace octant::models::simplify
