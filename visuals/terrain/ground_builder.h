#pragma once

#include "models/heights/height_field.h"
#include "visuals/terrain/ground_tiles.h"

namespace octant::visuals::terrain {

/// The heights and errors of a field, in memory of their own, so that the field is not needed afterwards. Heights are
/// rounded to the finest power of two of a metre with which the field's range fits into 16 bits. The same bytes for any
/// number of threads.
GroundTiles make_ground_tiles(const models::heights::HeightField& field, int threads = 2);

} // namespace octant::visuals::terrain
