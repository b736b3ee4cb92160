#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace octant::visuals::terrain {

/// A perspective picture as far as measurements need it. World axes, metres.
struct PerspectiveView {
    glm::dvec3 eye_m{0.0};
    glm::dvec3 right{1.0, 0.0, 0.0}; ///< Together with `up` and `ahead`: orthogonal unit vectors.
    glm::dvec3 up{0.0, 0.0, 1.0};
    glm::dvec3 ahead{0.0, 1.0, 0.0};
    double focal_px = 869.1; ///< As MeshView::focal_px.
    double half_width_px = 640.0;
    double half_height_px = 360.0;
    double near_m = 10.0; ///< Nothing nearer is measured.

    /// Converts a vector relative to the eye to view axes (right, up, ahead), metres.
    glm::dvec3 seen_m(const glm::dvec3& from_eye_m) const {
        return {glm::dot(right, from_eye_m), glm::dot(up, from_eye_m), glm::dot(ahead, from_eye_m)};
    }

    /// Whether a point in view axes is in the picture.
    bool shows(const glm::dvec3& seen) const {
        return seen.z >= near_m && focal_px * seen.x <= half_width_px * seen.z &&
               -focal_px * seen.x <= half_width_px * seen.z && focal_px * seen.y <= half_height_px * seen.z &&
               -focal_px * seen.y <= half_height_px * seen.z;
    }

    /// The pixels right of and above the middle. The point must be in front of the eye.
    glm::dvec2 pixel(const glm::dvec3& seen) const { return glm::dvec2(seen.x, seen.y) * (focal_px / seen.z); }
};

} // namespace octant::visuals::terrain
