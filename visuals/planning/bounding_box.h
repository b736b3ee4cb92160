#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <span>
#include <vector>

namespace octant::visuals::planning {

// Convex polygons as an eye sees them. World axes with the eye at the origin, metres.

/// A corner of a convex polygon, and the kind of the edge from it to the next corner.
struct ViewVertex {
    glm::dvec3 at_m{0.0};
    /// Whether clipping made the edge; else it is an edge of the original polygon.
    bool cut = false;
};

/// A polygon without corners is empty.
using ViewPolygon = std::vector<ViewVertex>;

/// Clips a convex polygon to the front of a plane. Corners within `tolerance_m` of the plane count as on it: they stay,
/// but a polygon with no corner farther in front becomes empty. `scratch`: memory for the result, reused by calls.
void clip_to_front(ViewPolygon& polygon, const Plane& plane, double tolerance_m, ViewPolygon& scratch);

/// Clips a convex polygon to the front of all planes through the eye with these normals.
void clip_to_cone(ViewPolygon& polygon, std::span<const glm::dvec3> normals, ViewPolygon& scratch);

/// The planes through the eye and the edges of a convex polygon that does not lie edge-on, unit normals pointing
/// inside, each turned outwards by `widening_rad`.
void cone_of(const ViewPolygon& polygon, double widening_rad, std::vector<glm::dvec3>& inward_normals);

/// Plane of a polygon, its front where the corners run counter-clockwise; unit normal.
Plane plane_of(const ViewPolygon& polygon);

/// The mean of the corners.
glm::dvec3 middle_of(const ViewPolygon& polygon);

/// The solid angle of a small polygon as seen by the eye, steradians. For a large one the result is too small, but
/// above zero.
double solid_angle_sr(const ViewPolygon& polygon);

/// Polygons with a smaller solid angle are left out, because they hardly ever cover a pixel's centre: a pixel of a
/// picture of 4,000 lines covers 1e-8.
inline constexpr double min_solid_angle_sr = 1e-13;

/// A box along the axes, given by two opposite corners.
struct AxisAlignedBox {
    glm::dvec3 min_m{0.0};
    glm::dvec3 max_m{0.0};
};

/// The smallest body-axes box around a model at all angles of its pivots. Loading work.
AxisAlignedBox model_bounds(const models::polygons::PolygonModel& model);

/// The smallest box around the circle on which a point turns about the axis of a pivot.
AxisAlignedBox rotation_bounds(const models::polygons::Pivot& pivot, const glm::dvec3& point_m);

/// The bounding box of one aircraft or of several: world axes with the eye at the origin.
struct OrientedBox {
    glm::dvec3 centre_m{0.0};
    /// Columns are unit vectors along the edges.
    glm::dmat3 axes{1.0};
    glm::dvec3 half_m{0.0};
};

/// A body-axes box at `position_m` (eye at the origin) as an oriented box, enlarged by `margin_m` on all sides.
OrientedBox placed_box(
    const AxisAlignedBox& extent, const glm::dvec3& position_m, const glm::dquat& body_to_world, double margin_m);

std::array<glm::dvec3, 8> corners_of(const OrientedBox& box);

/// The smallest box along the world's axes around a box.
AxisAlignedBox world_bounds(const OrientedBox& box);

/// The same box as an oriented box.
OrientedBox oriented_box(const AxisAlignedBox& extent);

/// The radius of the sphere about the centre through the corners, metres.
double radius_m(const OrientedBox& box);

/// The plane of side 0 to 5 of a box; its front is outside.
Plane side_of(const OrientedBox& box, int side);

/// Clips a convex polygon to the inside of a box.
void clip_to_box(ViewPolygon& polygon, const OrientedBox& box, ViewPolygon& scratch);

/// True for an eye inside the box or on it.
bool contains_eye(const OrientedBox& box);

/// The planes through the eye and the outline of a box as the eye sees it, unit normals pointing inside: the box is in
/// front of all of them.
struct ViewCone {
    std::array<glm::dvec3, 6> normals{};
    int count = 0;

    std::span<const glm::dvec3> planes() const { return std::span(normals).first(static_cast<std::size_t>(count)); }
};

/// The eye must be outside the box.
ViewCone cone_of(const OrientedBox& box);

/// The planes along parallel light through the outline of a box, unit normals pointing inside: the box is in front of
/// all of them.
struct LightPrism {
    std::array<Plane, 6> planes{};
    int count = 0;
};

/// `from`: a unit vector towards the light.
LightPrism prism_of(const OrientedBox& box, const glm::dvec3& from);

/// The multiple of `ray`, a vector from the eye inside the box's cone, at which it enters the box.
double entry_distance(const OrientedBox& box, const glm::dvec3& ray);

/// Which of two boxes can hide part of the other from the eye. At most one can if they do not intersect.
struct OcclusionPair {
    bool intersect = false;
    bool a_occludes_b = false;
    bool b_occludes_a = false;
};

OcclusionPair occlusion_pair(const OrientedBox& a, const OrientedBox& b);

} // namespace octant::visuals::planning
