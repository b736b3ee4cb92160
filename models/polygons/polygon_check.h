#pragma once

#include "models/polygons/polygon_model.h"

#include <glm/vec3.hpp>

#include <optional>
#include <span>
#include <string>

namespace octant::models::polygons {

/// How far a corner may lie beside its polygon's plane or an edge's line before the polygon counts as bent or dented:
/// 1e-4 of the diameter of the sphere about the mean of the model's vertices that holds them all, metres, however the
/// model lies. Wide enough for files that keep four digits, too narrow to see.
double flatness_tolerance_m(const PolygonModel& model);

/// What is wrong with one polygon, as "expected ..., got ..."; nothing for a good one. Checked in this order: two
/// corners in one place, no area, corners off the plane of Newell's sum through their middle, corners outside the line
/// of an edge (dents and stars). Corners in the middle of a straight side are allowed. The polygon has at least 3
/// corners, all finite. Corners are named by their place in the polygon, from 1.
std::optional<std::string> polygon_fault(const PolygonModel& model, std::size_t polygon, double tolerance_m);

/// What is wrong with a polygon given by its corners alone, as polygon_fault says it.
std::optional<std::string> corners_fault(std::span<const glm::dvec3> corners_m, double tolerance_m);

/// What is wrong with corners that could not even be cut into convex planar pieces: two corners in one place or no
/// area.
std::optional<std::string> outline_fault(std::span<const glm::dvec3> corners_m);

/// True when all corners lie on one line, or in one place.
bool is_line(std::span<const glm::dvec3> corners_m);

/// True when all corners lie on the plane of Newell's sum through their middle.
bool is_planar(std::span<const glm::dvec3> corners_m, double tolerance_m);

} // namespace octant::models::polygons
