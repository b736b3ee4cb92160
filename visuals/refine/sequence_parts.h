#pragma once

#include "models/collapse_sequence.h"
#include "visuals/refine/progressive_mesh.h"

namespace octant::visuals::refine {

/// The parts of a hierarchy from a sequence of collapses: leaves renumbered, normals of all nodes.
ProgressiveParts parts_of(const models::CollapseSequence& sequence);

} // namespace octant::visuals::refine
