#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/face.h"

#include <cstddef>

namespace octant::visuals::draworder {

/// The face that stands for a polygon of a turning part, chosen so that an order holds at every angle.
///
/// At any angle the polygon lies within what it sweeps, and the stand-in contains that. The hiding test is monotone in
/// both faces: what hides or is hidden at some angle also does so in the test. So an order that keeps the precedences
/// of the stand-ins is right at every angle, though it may keep some that no angle needs.
///
/// A polygon whose plane is perpendicular to the axis sweeps a ring of that plane. Its stand-in is a regular polygon of
/// 24 corners around the ring's outer circle, seen from the same side. Any other polygon sweeps a solid of revolution.
/// Its stand-in is the convex hull of regular polygons around the circles of its corners: a body, which is seen from
/// all sides because the polygon turns.
///
/// Polygons of one part keep their places to one another while, in their frame, the eye goes round them. They are
/// compared as they stand in the file, with eyes everywhere (ModelFaces::rigid).
///
/// `scale` converts metres about `origin_m` to the unit of the face; `inset` is that of Tolerances.
Face swept_face(const models::polygons::PolygonModel& model, std::size_t polygon, const models::polygons::Pivot& pivot,
    const glm::dvec3& origin_m, double scale, double inset);

} // namespace octant::visuals::draworder
