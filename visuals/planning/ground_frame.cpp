#include "visuals/planning/ground_frame.h"

#include <algorithm>
#include <cstddef>

namespace octant::visuals::planning {

std::span<const ShadowPieces> shadows_on(const GroundFrame& ground, std::uint32_t triangle) {
    const auto first = std::ranges::lower_bound(ground.shadows, triangle, {}, &ShadowPieces::triangle);
    const auto last = std::ranges::upper_bound(ground.shadows, triangle, {}, &ShadowPieces::triangle);
    return {first, last};
}

void place_triangle(const scene::TriangleDraw& ground, std::uint32_t triangle, ViewPolygon& placed) {
    placed.resize(3);
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t vertex = ground.indices[std::size_t{3} * triangle + corner];
        placed[corner] = {glm::dvec3(ground.vertices[vertex].position_m), false};
    }
}

} // namespace octant::visuals::planning
