#pragma once

#include "models/collapse_sequence.h"
#include "visuals/refine/progressive_mesh_data.h"

namespace octant::visuals::refine {

/// The parts of a hierarchy from a simplification's sequence of collapses. The leaves are
/// renumbered so that those below any node are consecutive, and every node gets a normal.
ProgressiveMeshData mesh_data_of(const models::CollapseSequence& sequence);

} // namespace octant::visuals::refine
