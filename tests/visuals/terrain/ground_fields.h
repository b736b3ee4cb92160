#pragma once

#include "models/heights/height_field.h"
#include "tests/rough_heights.h"

namespace octant::visuals::terrain {

/// Rough ground of whole metres, 30 m apart, the same for the same seed.
inline models::heights::HeightField
rough_field(int columns, int rows, unsigned seed = 1, int range_m = 900) {
    return {columns, rows, 30.0, tests::rough_heights(columns, rows, seed, range_m)};
}

} // namespace octant::visuals::terrain
