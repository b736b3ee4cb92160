#pragma once

#include "visuals/shading/intensity.h"

#include <glm/vec3.hpp>

namespace octant::visuals::shading {

/// How much the eye and the light may change before smooth polygons are chosen again.
struct ReselectionTolerance {
    /// The eye may move by this angle about the model's centre, and the light may turn by it.
    double angle_rad = 0.03;
    /// The distance from the eye to the centre may change by this share of itself.
    double distance_share = 0.05;
};

/// The eye and the light that a choice was made for, in the model's axes.
struct ViewAndLight {
    glm::dvec3 eye_m{0.0};
    ShadingLight light;
};

/// Whether `now` differs from `before` by more than the tolerance, for a model with its centre at `centre_m`. Any
/// change of the light but its direction counts.
bool needs_reselection(const ViewAndLight& before, const ViewAndLight& now, const glm::dvec3& centre_m,
    const ReselectionTolerance& tolerance);

} // namespace octant::visuals::shading
