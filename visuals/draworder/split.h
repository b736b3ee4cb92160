#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"

#include <cstddef>
#include <cstdint>

namespace octant::visuals::draworder {

/// How far a corner may lie beside a plane and still count as on it when a polygon is cut: 1e-7 of
/// the diagonal of the model's bounding box, metres.
double split_tolerance_m(const models::polygons::PolygonModel& model);

/// Cuts a polygon along a plane (unit normal). The piece in front of the plane keeps the number,
/// the piece behind it is appended; returns its number. Both keep material and part, and
/// model.parents says of which polygon of the file they are.
///
/// The corners on the cut are shared by both pieces. Where the cut passes through a side, its
/// vertex also becomes a corner of every other polygon that has this side (the same two places as
/// neighbours), so that no crack opens; corners in the middle of a straight side result.
///
/// Corners lie more than split_tolerance_m away on both sides of the plane (asserted). Time grows
/// with the corners of the whole model.
std::uint32_t
split_polygon(models::polygons::PolygonModel& model, std::size_t polygon, const Plane& plane);

/// Cuts polygons that pass through one another until none does, each along the plane of another;
/// returns how many polygons were added. In each step the cut is made that leaves the fewest pairs,
/// the lowest polygon numbers among equals.
///
/// Two polygons pass through one another when each has corners on both sides of the other's plane
/// and they share more than a point of the line in which the planes meet. Polygons that only touch
/// (shared edges, T-joints, a corner on a face) do not; less than flatness_tolerance_m
/// (models/polygon_check.h) is touching. A polygon that turns about a pivot is cut only against
/// those that turn about the same one.
int split_penetrating(models::polygons::PolygonModel& model);

} // namespace octant::visuals::draworder
