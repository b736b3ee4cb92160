#pragma once

#include "visuals/verify/certificate.h"
#include "visuals/verify/sides.h"

#include <vector>

namespace octant::visuals::verify {

/// All pairs of polygons that overlap in one plane and of which the later one of the model's file
/// has to be painted later.
std::vector<Pair> stacked_pairs(const Certificate& certificate, const Sides& sides);

} // namespace octant::visuals::verify
