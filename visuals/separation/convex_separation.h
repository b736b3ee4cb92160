#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <span>

namespace octant::visuals::separation {

/// Whether a plane has the points `b` on one side and, on the other, the points `a` and all eyes of the region that
/// `eyes` generates (ViewRegion::append_generators), with some margin between the plane and the points. If so, no
/// segment from a point of `a` to an eye meets the convex hull of `b`. Works for flat and for solid sets alike. Lengths
/// are in the unit of ViewRegion. A false may be wrong because of rounding, a true never is.
bool separable(std::span<const glm::dvec3> b, std::span<const glm::dvec3> a, std::span<const glm::dvec4> eyes);

} // namespace octant::visuals::separation
