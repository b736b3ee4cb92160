#pragma once

#include "sim/base/plane.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// What is compared in place of a polygon: its outline, drawn in by a hair, so that polygons that
/// only touch do not hide one another; or what a turning polygon sweeps (turning_parts.h). Lengths
/// are in the unit of EyeRegion.
struct Face {
    std::vector<glm::dvec3> outline; ///< in turn, before it is drawn in; of a body in any order
    std::vector<glm::dvec3> corners; ///< drawn in
    std::optional<Plane> plane;   ///< of an outline, front where it is seen from; none for a body
    std::vector<glm::dvec2> flat; ///< corners in the axes right, up; counter-clockwise
    glm::dvec3 right{0.0};
    glm::dvec3 up{0.0};                 ///< cross(normal, right)
    std::optional<std::uint32_t> pivot; ///< index into PolygonModel::pivots of what turns it
};

/// How far beside a plane counts as on it, and how far outlines are drawn in.
struct Tolerances {
    double on_plane = 1e-7;
    double inset = 1e-6;
};

/// The face of a convex outline that lies in `plane` but for rounding: its corners dropped onto the
/// plane and every edge moved inwards by the inset, though by no more than a fifth of the least
/// distance between a corner and the middle.
Face outline_face(std::span<const glm::dvec3> corners, const Plane& plane, double inset);

/// The part of a convex outline in front of a plane that it straddles.
std::vector<glm::dvec3> front_part(const std::vector<glm::dvec3>& outline, const Plane& plane);

/// Whether all corners lie behind a plane or on it.
bool behind_or_on(const Face& face, const Plane& plane, double on_plane);

} // namespace octant::visuals::draworder
