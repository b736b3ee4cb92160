#pragma once

#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace octant::visuals::planning {

// What an eye sees of convex polygons. World axes with the eye at the origin, metres.

/// A corner of a convex polygon and how the edge from it to the next corner came about.
struct ViewVertex {
    glm::dvec3 at_m{0.0};
    /// Whether the edge is a cut, and not one of the polygon's own.
    bool cut = false;
};

/// Without corners nothing of it is left.
using ViewPolygon = std::vector<ViewVertex>;

/// Cuts a convex polygon down to the front of a plane. Corners within `tolerance_m` of the plane lie on it: they are
/// not cut off, but a polygon of which no corner lies farther in front is emptied. `scratch` keeps its memory between
/// calls.
void clip_to_front(ViewPolygon& polygon, const Plane& plane, double tolerance_m, ViewPolygon& scratch);

/// Cuts a convex polygon down to the common front of planes through the eye, given by normals.
void clip_to_cone(ViewPolygon& polygon, std::span<const glm::dvec3> normals, ViewPolygon& scratch);

/// The planes through the eye and the edges of a convex polygon that does not lie edge-on, unit normals pointing
/// inside, each turned outwards by `widening_rad`.
void cone_of(const ViewPolygon& polygon, double widening_rad, std::vector<glm::dvec3>& inward_normals);

/// Plane of a polygon, its front where the corners run counter-clockwise; unit normal.
Plane plane_of(const ViewPolygon& polygon);

/// Mean of the corners.
glm::dvec3 middle_of(const ViewPolygon& polygon);

/// Solid angle that a small polygon covers for the eye, steradians; a large one comes out too small, never zero.
double solid_angle_sr(const ViewPolygon& polygon);

/// What is seen smaller than this cannot meet a pixel's centre but by chance: a pixel of a picture of 4,000 lines
/// covers 1e-8.
inline constexpr double min_solid_angle_sr = 1e-13;

} // namespace octant::visuals::planning
