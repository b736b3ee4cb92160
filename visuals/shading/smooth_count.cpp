// How many polygons are smooth, by distance and by the device's speed: H. Kim, H. Park, "A Hybrid Rendering Model to
// support LOD (Level of Detail)", 2008, sections 3 and 4.
//
// Deviations: the printed n = (1 - d) g + d f contradicts f + g = n and has a pole at d = 1/2; the text means g = (1 -
// d) n. The paper does not say how its relative speed 0.028 leads to "8 or 9" of 415 polygons; the formula here counts
// the operations of its table 2 and is ours.
#include "visuals/shading/smooth_count.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace octant::visuals::shading {

namespace {

/// Selection and flat shading of one polygon, table 2.
constexpr double flat_operations = 9.0 + 1.0;
constexpr double smooth_operations = 9.0 + 4.0; ///< Selection and Gouraud shading of one polygon.

} // namespace

int smooth_count(double distance_m, const ShadingRange& range, int polygons) {
    assert(range.far_m > range.near_m && polygons >= 0);
    assert(range.levels == 0 || range.levels >= 2);
    double d = std::clamp((distance_m - range.near_m) / (range.far_m - range.near_m), 0.0, 1.0);
    if (range.levels > 0) {
        const double steps = range.levels - 1;
        d = std::round(d * steps) / steps;
    }
    return static_cast<int>(std::lround((1.0 - d) * polygons));
}

int device_smooth_count(double device_ratio, int polygons) {
    assert(device_ratio >= 0.0 && device_ratio <= 1.0 && polygons >= 0);
    const double operations_of_polygon = flat_operations + device_ratio * (smooth_operations - flat_operations);
    const double share = device_ratio * operations_of_polygon / smooth_operations;
    return static_cast<int>(std::lround(share * polygons));
}

} // namespace octant::visuals::shading
