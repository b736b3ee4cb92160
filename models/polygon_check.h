#pragma once

#include "models/polygon_model.h"

#include <optional>
#include <string>

namespace octant::models {

/// How far a corner may lie beside its polygon's plane or an edge's line before the polygon counts
/// as bent or dented: 1e-4 of the diagonal of the model's bounding box, metres. Wide enough for
/// files that keep four digits, too narrow to see.
double flatness_tolerance_m(const PolygonModel& model);

/// What is wrong with one polygon, as "expected ..., got ..."; nothing for a good one. Checked in
/// this order: two corners in one place, no area, corners off the plane of Newell's sum through
/// their middle, corners outside the line of an edge (dents and stars). Corners in the middle of a
/// straight side are allowed. The polygon has at least 3 corners, all finite. Corners are named by
/// their place in the polygon, from 1.
std::optional<std::string>
polygon_fault(const PolygonModel& model, std::size_t polygon, double tolerance_m);

} // namespace octant::models
