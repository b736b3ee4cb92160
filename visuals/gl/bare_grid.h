#pragma once

#include "models/colour_vertex.h"

#include <glm/mat4x4.hpp>

#include <cstdint>
#include <vector>

namespace octant::visuals::gl {

/// Hills over the whole picture and nothing else, for measuring what the platform itself costs.
struct BareGrid {
    std::vector<models::ColourVertex> vertices; ///< lit
    std::vector<std::uint32_t> indices;         ///< triangles, row after row, counter-clockwise
};

/// A grid of about `triangles` (at least 2, asserted; exact for 2 n^2, otherwise up to 2 rows more) seen through
/// `view_to_clip` (a symmetric perspective as scene::view_to_clip makes it) with the world's axes taken as the view's:
/// to be drawn as FramePlan::ground with world_to_view identity.
BareGrid bare_grid(int triangles, const glm::mat4& view_to_clip);

} // namespace octant::visuals::gl
