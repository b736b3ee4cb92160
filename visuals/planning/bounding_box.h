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

/// Corners of the smallest body-axes box that holds a model however its pivots have turned.
struct AxisAlignedBox {
    glm::dvec3 min_m{0.0};
    glm::dvec3 max_m{0.0};
};

/// The extent of a model, at all angles of its pivots. Slow: to be asked once, at loading.
AxisAlignedBox model_bounds(const models::polygons::PolygonModel& model);

/// The smallest box around the circle that a point runs about the axis of a pivot.
AxisAlignedBox rotation_bounds(const models::polygons::Pivot& pivot, const glm::dvec3& point_m);

/// A box that stands in for one aircraft, or for several: world axes with the eye at the origin.
struct OrientedBox {
    glm::dvec3 centre_m{0.0};
    /// Columns are unit vectors along the edges.
    glm::dmat3 axes{1.0};
    glm::dvec3 half_m{0.0};
};

/// The hull of an aircraft at `position_m` (eye at the origin), wider by `margin_m` on all sides.
OrientedBox placed_box(
    const AxisAlignedBox& extent, const glm::dvec3& position_m, const glm::dquat& body_to_world, double margin_m);

std::array<glm::dvec3, 8> corners_of(const OrientedBox& box);

/// Corners of the smallest box along the world's axes that holds the box.
AxisAlignedBox world_bounds(const OrientedBox& box);

/// The box along the world's axes between two corners.
OrientedBox oriented_box(const AxisAlignedBox& extent);

/// Radius of the sphere around the centre through the corners, metres.
double radius_m(const OrientedBox& box);

/// Plane of side 0 .. 5 of a box, its front outside.
Plane side_of(const OrientedBox& box, int side);

/// Cuts a convex polygon down to the inside of a box.
void clip_to_box(ViewPolygon& polygon, const OrientedBox& box, ViewPolygon& scratch);

/// True for an eye inside the box or on it.
bool contains_eye(const OrientedBox& box);

/// The planes through the eye and the outline of a box as the eye sees it, unit normals pointing inside. The box, and
/// what it holds, lies in front of all of them.
struct ViewCone {
    std::array<glm::dvec3, 6> normals{};
    int count = 0;

    std::span<const glm::dvec3> planes() const { return std::span(normals).first(static_cast<std::size_t>(count)); }
};

/// Seen from an eye outside the box.
ViewCone cone_of(const OrientedBox& box);

/// The same for light that comes from the unit vector `from`: planes along the light, unit normals pointing inside,
/// with the box in front of all of them.
struct LightPrism {
    std::array<Plane, 6> planes{};
    int count = 0;
};

LightPrism prism_of(const OrientedBox& box, const glm::dvec3& from);

/// Multiple of `ray` (from the eye, into the box's cone) at which it enters the box.
double entry_distance(const OrientedBox& box, const glm::dvec3& ray);

/// Which of two boxes can hide part of the other from the eye; for boxes that do not meet at most one can.
struct OcclusionPair {
    bool intersect = false;
    bool a_occludes_b = false;
    bool b_occludes_a = false;
};

OcclusionPair occlusion_pair(const OrientedBox& a, const OrientedBox& b);

} // namespace octant::visuals::planning
