#pragma once

#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <array>
#include <span>

namespace octant::models::simplify {

/// How much a triangle may change when one of its corners moves.
enum class Strictness {
    Strips, ///< As Normal, but it may also become a sliver if it keeps its normal.
    Normal, ///< It may turn by less than 78 degrees and may not become a sliver.
    Loose,  ///< It may turn by less than 90 degrees.
    None    ///< Anything is allowed.
};

/// Whether a triangle with corners `before` may get the corners `after`. One that is no higher than
/// `negligible` before and after, in working units, may turn over: that is no more wrong than the
/// surface is already, and the rim of a thin plate cannot go otherwise.
bool may_become(
    const std::array<glm::dvec3, 3>& before,
    const std::array<glm::dvec3, 3>& after,
    Strictness strictness,
    double negligible = 0.0);

/// Whether the two triangles at an edge may become the two given ones when the edge is flipped,
/// whichever new one is compared with whichever old one.
bool may_flip_to(
    const std::array<std::array<glm::dvec3, 3>, 2>& before,
    const std::array<std::array<glm::dvec3, 3>, 2>& after);

/// Whether every triangle of a ring may have its moving corner at `place`, by may_become.
bool may_move(
    const WorkingSurface& surface,
    std::span<const RingFace> ring,
    const glm::dvec3& place,
    Strictness strictness,
    double negligible = 0.0);

/// Strips for an uncoloured surface on which at least every fourth edge is flat, as on machined
/// parts with long strips along their cylinders; else Normal.
Strictness strictness_for(const WorkingSurface& surface);

/// The corners of a triangle of a ring when its moving corner is at `place`; that corner comes
/// first.
std::array<glm::dvec3, 3>
moved_corners(const WorkingSurface& surface, const RingFace& face, const glm::dvec3& place);

} // namespace octant::models::simplify
