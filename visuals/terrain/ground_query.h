#pragma once

#include "visuals/terrain/ground_samples.h"

#include <glm/vec3.hpp>

#include <optional>

namespace octant::visuals::terrain {

// Queries against the full-resolution ground. Its surface is bilinear between four samples, and lines are intersected
// with it exactly, cell by cell. The earth's curvature lowers everything at a horizontal distance d from the eye by d^2
// / (2 R); R = 0 is a flat earth.

/// The height of the ground; nothing outside the field.
std::optional<double> ground_height_m(const GroundSamples& ground, double x_m, double y_m);

/// What lies between two points.
struct LineOfSight {
    bool visible = true; ///< The line is nowhere more than a micrometre below the ground.
    /// The first point of the ground that hides, in world axes.
    std::optional<glm::dvec3> blocked_at_m;
    /// The height of the line above the ground where that is least; infinite where there is no ground below the line.
    double clearance_m = 0.0;
    glm::dvec3 min_clearance_at_m{0.0}; ///< The point of the ground at which the clearance is least.
};

/// Whether `to_m` is seen from `from_m`, both in world axes.
LineOfSight line_of_sight(
    const GroundSamples& ground, const glm::dvec3& from_m, const glm::dvec3& to_m, double radius_m);

/// The first point at which a ray meets the ground; nothing if it does not within `reach_m`. The direction is a unit
/// vector. The ray is straight and the ground is lowered by curvature; what is returned is the ground point at its own
/// height.
std::optional<glm::dvec3> intersect_ground(const GroundSamples& ground, const glm::dvec3& from_m,
    const glm::dvec3& direction, double reach_m, double radius_m);

} // namespace octant::visuals::terrain
