#pragma once

#include "models/planar/planar_model.h"
#include "sim/base/plane.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// What is compared in place of a polygon: its outline, shrunk by a hair so that polygons which only touch do not hide
/// one another, or a body that a turning polygon sweeps (turning_parts.h). Lengths are in the unit of ViewRegion.
struct Face {
    /// Before shrinking; in order around an outline, in any order for a body.
    std::vector<glm::dvec3> outline;
    std::vector<glm::dvec3> corners; ///< After shrinking.
    /// The plane of an outline, its front where it is seen from; a body has none.
    std::optional<Plane> plane;
    /// The corners in the coordinates (right, up), counter-clockwise.
    std::vector<glm::dvec2> flat;
    std::vector<glm::dvec2> edge_directions; ///< The unit directions from each of them to the next one.
    glm::dvec3 right{0.0};
    glm::dvec3 up{0.0};                 ///< Equal to cross(normal, right).
    std::optional<std::uint32_t> pivot; ///< The index in PolygonModel::pivots of what turns it.
};

/// Tolerances of hiding tests, in the unit of ViewRegion.
struct Tolerances {
    /// Outlines are shrunk by this distance.
    double inset = models::planar::planar_tolerance;
    /// A point within this distance of a plane counts as on it.
    double on_plane = inset / 10.0;
};

/// The face of a convex outline that lies in `plane` but for rounding. Its corners are projected onto the plane, and
/// every edge is moved inwards by the inset, but by no more than a fifth of the least distance between a corner and the
/// centroid.
Face outline_face(std::span<const glm::dvec3> corners, const Plane& plane, double inset);

/// The part of a convex outline in front of a plane that it straddles. Corners within `on_plane` of the plane belong to
/// it as they are, so that no two corners lie closer together than those of the outline.
std::vector<glm::dvec3> front_part(const std::vector<glm::dvec3>& outline, const Plane& plane, double on_plane);

/// Whether all corners of a face lie behind a plane or on it.
bool behind_or_on(const Face& face, const Plane& plane, double on_plane);

/// Whether two outlines that face the same way lie in one plane, within `on_plane`, and overlap there. Not those that
/// turn.
bool overlap_in_plane(const Face& a, const Face& b, double on_plane);

} // namespace octant::visuals::draworder
