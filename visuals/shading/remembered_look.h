#pragma once

#include "visuals/shading/intensity.h"

#include <glm/vec3.hpp>

namespace octant::visuals::shading {

/// How much eye and light may change before a choice is looked at again.
struct LookTolerance {
    /// By more than this the eye has moved about a model's middle, or the light has turned.
    double angle_rad = 0.03;
    /// Or the eye is farther or nearer by more than this share of its distance.
    double distance_share = 0.05;
};

/// Eye and light that a choice was made for.
struct RememberedLook {
    glm::dvec3 eye_m{0.0};
    ShadingLight light;
};

/// Whether `now` is another look at a model about `centre_m`.
bool is_other_look(
    const RememberedLook& before,
    const RememberedLook& now,
    const glm::dvec3& centre_m,
    const LookTolerance& tolerance);

} // namespace octant::visuals::shading
