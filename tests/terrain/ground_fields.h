#pragma once

#include "models/height_field.h"

namespace octant::visuals::terrain {

/// Rough ground of whole metres, the same for the same seed.
models::HeightField rough_field(int columns, int rows, unsigned seed = 1, int range_m = 900);

} // namespace octant::visuals::terrain
