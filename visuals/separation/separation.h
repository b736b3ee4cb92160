#pragma once

#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace octant::visuals::separation {

/// Errors smaller than this pass. Coordinates are in units of the model's diagonal, from its centre.
inline constexpr double check_tolerance = 1e-6;

/// How it was proved that one polygon hides nothing of another, the strongest proof first.
enum class SeparationMethod {
    Plane,         ///< A plane of the region itself separates them.
    LinearProgram, ///< A plane that a linear programme found separates them.
    None           ///< There is no proof.
};

/// Proves that no eye of a region sees `occluder` in front of `far_one`, by a plane with occluder behind it and far_one
/// and the region in front, all weakly. The region is the intersection of the half-spaces in front of `planes` (unit
/// normals); a region without interior is separated from everything.
SeparationMethod find_separation(
    std::span<const glm::dvec3> occluder, std::span<const glm::dvec3> far_one, std::span<const Plane> planes);

/// Whether no point of the intersection of the half-spaces in front of `planes` is in front of `plane` by more than the
/// tolerance times (1 + its distance from the origin).
bool is_behind(std::span<const Plane> planes, const Plane& plane, double tolerance = check_tolerance);

/// The planes, in their order, without those that the others imply.
std::vector<Plane> without_redundant(std::span<const Plane> planes);

} // namespace octant::visuals::separation
