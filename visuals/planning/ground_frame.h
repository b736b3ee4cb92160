#pragma once

#include "visuals/planning/ground_decals.h"
#include "visuals/planning/view_polygon.h"
#include "visuals/scene/frame_plan.h"

#include <cstdint>
#include <span>

namespace octant::visuals::planning {

/// Indices of pieces that lie on one triangle, of shadows or painted, numbered as FramePlan::repaint_indices are.
struct ShadowPieces {
    /// The number of the triangle in GroundMesher::triangles().
    std::uint32_t triangle = 0;
    /// The place of the first index among the pieces' indices.
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    GroundLayer layer = GroundLayer::Shadow;
};

/// The ground of one frame before facing, with the shadows on it.
struct GroundFrame {
    /// What GroundMesher::triangles() gave, in painting order.
    scene::TriangleDraw all;
    /// What lies on triangles, by ascending triangle and then from layer to layer.
    std::span<const ShadowPieces> shadows;
    std::span<const std::uint32_t> shadow_indices;
};

/// What lies on a triangle, in painting order.
std::span<const ShadowPieces> shadows_on(const GroundFrame& ground, std::uint32_t triangle);

/// Three corners of a triangle of the ground.
void place_triangle(const scene::TriangleDraw& ground, std::uint32_t triangle, ViewPolygon& placed);

} // namespace octant::visuals::planning
