#pragma once

#include "visuals/verify/certificate.h"
#include "visuals/verify/exact_sides.h"

#include <vector>

namespace octant::visuals::verify {

/// All pairs of polygons that overlap in one plane and of which the later one of the model's file
/// has to be painted later.
std::vector<PolygonPair> coplanar_layer_pairs(const Certificate& certificate, const ExactSides& sides);

} // namespace octant::visuals::verify
