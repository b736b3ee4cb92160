#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/dice.h"
#include "visuals/draworder/ray_check.h"

namespace octant::tests {

using visuals::draworder::count_wrong_rays;
using visuals::draworder::EyeSamples;
using visuals::draworder::RayCount;

/// Vertices V1 .. V14 and polygons P1 .. P10 of the 1989 paper's example (tables 2 and 3), its
/// x, y, z taken as body axes.
models::polygons::PolygonModel paper_example();

} // namespace octant::tests
