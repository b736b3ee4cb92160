#pragma once

#include "visuals/planning/ground_frame.h"
#include "visuals/scene/frame_plan.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// The triangles of the ground that face the eye, in their order, each with its shadow pieces directly behind it, as a
/// draw of the same vertices; `kept` holds its indices. Triangles seen so nearly edge-on that a renderer's rounding of
/// screen positions may turn them round are kept too: a renderer that drops them by their unrounded facing leaves holes
/// of single pixels. `pixel_rad`: angle that a pixel covers in the middle of the picture.
scene::TriangleDraw front_facing(const GroundFrame& ground, double pixel_rad, std::vector<std::uint32_t>& kept);

/// The same triangles without shadows, those that face away but for rounding at the end: `edge_on_indices` is how many
/// indices these have.
scene::TriangleDraw front_facing_first(
    const scene::TriangleDraw& draw, double pixel_rad, std::vector<std::uint32_t>& kept, std::size_t& edge_on_indices);

} // namespace octant::visuals::planning
