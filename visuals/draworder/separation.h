#pragma once

#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Coordinates here are in units of the model's diagonal, from its middle. What is wrong by less
/// than this passes.
inline constexpr double check_tolerance = 1e-6;

/// How it was shown that one polygon hides nothing of another.
enum class Certificate {
    Plane,           ///< a plane of the region itself parts them
    LinearProgramme, ///< a plane parts them that a linear programme found
    None
};

/// Shows that no eye of a region sees `near_one` before `far_one`: a plane with near_one behind it
/// and far_one and the region in front, all weakly. The region is the common front of `planes`
/// (unit normals); a region without inside is separated from everything.
Certificate separated(
    std::span<const glm::dvec3> near_one,
    std::span<const glm::dvec3> far_one,
    std::span<const Plane> planes);

/// Whether no point of the common front of `planes` lies in front of `plane` by more than the
/// tolerance times (1 + its distance from the origin).
bool is_behind(
    std::span<const Plane> planes, const Plane& plane, double tolerance = check_tolerance);

/// The planes without those in front of which the others' common front lies anyway, in their order.
std::vector<Plane> without_redundant(std::span<const Plane> planes);

} // namespace octant::visuals::draworder
