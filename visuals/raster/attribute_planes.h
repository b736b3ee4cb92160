#pragma once

#include "visuals/raster/draw_style.h"
#include "visuals/raster/projection.h"
#include "visuals/raster/triangle.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>

namespace octant::visuals::raster {

/// Makes planes over the picture from values at the three corners of a triangle, wherever these
/// lie, behind the eye, too.
class PlaneSolver {
public:
    PlaneSolver(const std::array<ClipPosition, 3>& vertices, const Projection& projection);

    /// Of value / w.
    AttributePlane plane(const glm::dvec3& values) const;

private:
    glm::dmat3 from_values_{0.0}; ///< takes values to factors of x / w, y / w and 1
    glm::dvec2 half_px_{0.0};
};

/// Fills in a triangle's depth, from the plane of 1 / w, as the style uses it.
void set_depth(
    TriangleExtra& extra,
    const AttributePlane& over_w,
    const DrawStyle& style,
    const Projection& projection);

/// Where a triangle lies in front of a plane in world axes with the eye subtracted.
ClipLine clip_line(
    const glm::vec4& plane,
    const AttributePlane& over_w,
    const scene::FramePlan& plan,
    const Projection& projection);

} // namespace octant::visuals::raster
