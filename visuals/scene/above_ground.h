#pragma once

#include "sim/base/ground_height.h"

#include <glm/vec3.hpp>

#include <algorithm>

namespace octant::visuals::scene {

/// Lifts an eye point that is below the ground or within 2 m of it.
inline void lift_above_ground(glm::dvec3& eye_m, const GroundHeight& ground) {
    constexpr double min_height_m = 2.0;
    if (const auto height_m = ground(eye_m.x, eye_m.y)) { eye_m.z = std::max(eye_m.z, *height_m + min_height_m); }
}

} // namespace octant::visuals::scene
