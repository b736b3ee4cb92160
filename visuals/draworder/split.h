#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"
#include "visuals/draworder/search_budget.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Adds to a painting list the pieces that were cut off its polygons after it was made, each behind what it was cut
/// from. As they lie in one plane, and a piece hides no more than the whole did, the list stays right. `cut_from[i]` is
/// what piece `first` + i was cut from, with a lower number; the list has numbers below `first` only.
void insert_cut_pieces(std::vector<std::uint32_t>& list, std::span<const std::uint32_t> cut_from, std::uint32_t first);

/// The distance from a plane within which a corner counts as on it: planar_tolerance times half the diagonal of the
/// model's bounding box, in the unit of the model.
double split_tolerance_m(const models::polygons::PolygonModel& model);

/// Cuts a polygon along a plane (unit normal). The piece in front of the plane keeps the number, the piece behind it is
/// appended; its number is returned. Both keep material and part, and model.parents holds the polygon of the file of
/// which they are pieces.
///
/// The corners on the cut are shared by both pieces. Where the cut passes through a side, its new vertex also becomes a
/// corner of every other polygon with that side (the same two positions as neighbours), so that no crack opens; such
/// corners lie in the middle of a straight side.
///
/// The polygon must have corners more than split_tolerance_m away on both sides of the plane (asserted). The time grows
/// with the corners of the whole model.
std::uint32_t split_polygon(models::polygons::PolygonModel& model, std::size_t polygon, const Plane& plane);

/// Cuts polygons that pass through one another until none does, each along the plane of another, and returns how many
/// polygons were added. Each step makes the cut that leaves the fewest pairs, with the lowest polygon numbers among
/// equals.
///
/// Two polygons pass through one another when each has corners on both sides of the other's plane and they share more
/// than a point of the line in which the planes meet. Polygons that only touch (shared edges, T-joints, a corner on a
/// face) do not; anything within split_tolerance_m is touching. A polygon that turns about a pivot is cut only against
/// those that turn about the same one.
///
/// Counts its work; throws SearchGivenUp when the budget is spent, or when a model needs more cuts than cells could be
/// found for.
int split_penetrating(models::polygons::PolygonModel& model, SearchBudget& budget);

} // namespace octant::visuals::draworder
