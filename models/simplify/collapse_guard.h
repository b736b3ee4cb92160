#pragma once

#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <array>
#include <span>

namespace octant::models::simplify {

/// How much a triangle may change when a corner of it moves.
enum class Strictness {
    Strips, ///< as Normal, but may become one where it keeps its normal
    Normal, ///< may turn by less than 78 degrees and not become a sliver
    Loose,  ///< may turn by less than 90 degrees
    None
};

/// Whether the triangle may get these corners.
bool may_become(
    const std::array<glm::dvec3, 3>& before,
    const std::array<glm::dvec3, 3>& after,
    Strictness strictness);

/// Whether two triangles on either side of an edge may become these when it is flipped: whichever
/// is taken for which.
bool may_flip_to(
    const std::array<std::array<glm::dvec3, 3>, 2>& before,
    const std::array<std::array<glm::dvec3, 3>, 2>& after);

/// Whether all triangles of a ring may have their moving corner at `place`.
bool may_move(
    const WorkingSurface& surface,
    std::span<const RingFace> ring,
    const glm::dvec3& place,
    Strictness strictness);

/// Strips for an uncoloured surface of which every fourth edge is flat: machined, with long strips
/// along its cylinders. Else Normal.
Strictness strictness_for(const WorkingSurface& surface);

/// A ring's triangle with its moving corner elsewhere; that corner comes first.
std::array<glm::dvec3, 3>
moved_corners(const WorkingSurface& surface, const RingFace& face, const glm::dvec3& place);

} // namespace octant::models::simplify
