#pragma once

#include "visuals/refine/progressive_mesh.h"
#include "visuals/refine/selective_refiner.h"

namespace octant::visuals::refine {

/// Which neighbourhood must be active before a node may split.
enum class SplitRule {
    Selective, ///< Kim & Lee 2000, 2001: two different active cut vertices.
    Hoppe,     ///< Hoppe 1997: the faces next to the two removed ones at collapse time.
    Xia        ///< Xia & Varshney 1996: all vertices of the 1-ring at collapse time.
};

/// RefinerOptions::required_split for a rule over one hierarchy; empty for Selective. Hoppe and Xia replay all
/// collapses of the mesh once, to find the neighbourhood of each.
RequiredSplit required_split_of(SplitRule rule, const ProgressiveMesh& mesh);

} // namespace octant::visuals::refine
