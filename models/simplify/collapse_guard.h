#pragma once

#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <array>
#include <span>

namespace octant::models::simplify {

/// Whether a triangle with corners `before` may get the corners `after`: it turns by less than 90
/// degrees and has an area. One without an area may become any that has one.
bool may_become(
    const std::array<glm::dvec3, 3>& before, const std::array<glm::dvec3, 3>& after);

/// Whether the two triangles at an edge may become the two given ones when the edge is flipped,
/// whichever new one is compared with whichever old one.
bool may_flip_to(
    const std::array<std::array<glm::dvec3, 3>, 2>& before,
    const std::array<std::array<glm::dvec3, 3>, 2>& after);

/// Whether every triangle of a ring may have its moving corner at `place`, by may_become.
bool may_move(
    const WorkingSurface& surface, std::span<const RingFace> ring, const glm::dvec3& place);

/// The corners of a triangle of a ring when its moving corner is at `place`; that corner comes
/// first.
inline std::array<glm::dvec3, 3>
moved_corners(const WorkingSurface& surface, const RingFace& face, const glm::dvec3& place) {
    return {
        place,
        surface.places[surface.mesh.target(face.half_edge)],
        surface.places[surface.mesh.origin(previous_of(face.half_edge))]};
}

} // namespace octant::models::simplify
