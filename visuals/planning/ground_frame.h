#pragma once

#include "visuals/planning/sight.h"
#include "visuals/scene/frame_plan.h"

#include <cstdint>
#include <span>

namespace octant::visuals::planning {

/// Indices of one triangle's shadow pieces, numbered as FramePlan::repaint_indices are.
struct ShadowPieces {
    /// The number of the triangle in GroundMesher::triangles().
    std::uint32_t triangle = 0;
    /// The place of the first index among the pieces' indices.
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// The ground of one frame before facing, with the shadows on it.
struct GroundFrame {
    /// What GroundMesher::triangles() gave, in painting order.
    scene::TriangleDraw all;
    /// Shadow pieces, by ascending triangle.
    std::span<const ShadowPieces> shadows;
    std::span<const std::uint32_t> shadow_indices;
};

/// The shadow pieces on a triangle.
std::span<const ShadowPieces> shadows_on(const GroundFrame& ground, std::uint32_t triangle);

/// Three corners of a triangle of the ground.
void place_triangle(
    const scene::TriangleDraw& ground, std::uint32_t triangle, SightPolygon& placed);

} // namespace octant::visuals::planning
