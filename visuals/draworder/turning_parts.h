#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/face.h"

#include <cstddef>

namespace octant::visuals::draworder {

/// What stands in for a polygon of a turning part, so that an order holds at every angle.
///
/// At any angle the polygon lies within what it sweeps, and the stand-in holds that. The hiding
/// test only grows with either face: what hides or is hidden at some angle is hidden in the test.
/// So an order that keeps the precedences of the stand-ins is right at every angle, though it may
/// keep some that no angle needs.
///
/// A polygon whose plane is perpendicular to the axis sweeps a ring of that plane; its stand-in is
/// a regular polygon of 24 corners around the ring's outer circle, seen from the same side. Any
/// other sweeps a solid of revolution; its stand-in is the hull of regular polygons around the
/// circles of its corners, a body, seen from all sides since its polygon turns.
///
/// Polygons of one part keep their places to one another, while the eye goes round them as they
/// turn; they are compared as they stand in the file and with eyes everywhere.
///
/// `scale`: factor from metres to the unit of the face, about `origin_m`.
Face turning_face(
    const models::polygons::PolygonModel& model,
    std::size_t polygon,
    const models::polygons::Pivot& pivot,
    const glm::dvec3& origin_m,
    double scale,
    double inset);

} // namespace octant::visuals::draworder
