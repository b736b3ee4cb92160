#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <span>

namespace octant::visuals::draworder {

/// Whether a plane has the points `b` on one side and, on the other, the points `a` and all eyes of
/// the region that `eyes` generates (EyeRegion::append_generators), with some air between the plane
/// and the points. If so, no segment from an `a` to an eye meets the hull of b. Works for flat and
/// for solid sets alike. Lengths in the unit of EyeRegion.
bool separable(
    std::span<const glm::dvec3> b, std::span<const glm::dvec3> a, std::span<const glm::dvec4> eyes);

} // namespace octant::visuals::draworder
