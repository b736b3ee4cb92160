#pragma once

#include "models/collapse_sequence.h"
#include "visuals/refine/progressive_parts.h"

namespace octant::visuals::refine {

/// The parts of a hierarchy from a simplification's sequence of collapses. The leaves are
/// renumbered so that those below any node are consecutive, and every node gets a normal.
ProgressiveParts parts_of(const models::CollapseSequence& sequence);

} // namespace octant::visuals::refine
