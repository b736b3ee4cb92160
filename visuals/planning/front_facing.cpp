#include "visuals/planning/front_facing.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>

namespace octant::visuals::planning {

namespace {

/// Renderers round screen positions to 1/256 pixel. Twice that bounds the error of both ends of an edge.
constexpr float rounding_px = 2.0F / 256.0F;

float sum_of_parts(const glm::vec3& v) {
    const glm::vec3 size = glm::abs(v);
    return size.x + size.y + size.z;
}

/// Corners relative to the eye. The triple product is the triangle's doubled area on the screen times distance cubed
/// times the pixel's angle squared; rounding moves that area by at most rounding_px times the outline. Sums of parts
/// bound lengths from above without a square root.
enum class Facing { Towards, AwayWithinTolerance, Away };

Facing facing_of(const scene::TriangleDraw& draw, const std::uint32_t* corners, float pixel_rad) {
    const glm::vec3& a = draw.vertices[corners[0]].position_m;
    const glm::vec3& b = draw.vertices[corners[1]].position_m;
    const glm::vec3& c = draw.vertices[corners[2]].position_m;
    const glm::vec3 ab = b - a;
    const glm::vec3 ac = c - a;
    const float edges_m = sum_of_parts(ab) + sum_of_parts(ac);
    const float distance_m = sum_of_parts(a) + edges_m;
    const float doubt = rounding_px * pixel_rad * 2.0F * edges_m * distance_m * distance_m;
    const float away = glm::dot(glm::cross(ab, ac), a);
    return away > doubt ? Facing::Away : away > 0.0F ? Facing::AwayWithinTolerance : Facing::Towards;
}

/// Copies the triangles first .. last - 1 that face the eye to the beginning of `kept`, which must have room for all of
/// them. Returns the number of indices copied.
std::size_t remove_back_faces(const scene::TriangleDraw& draw, std::size_t first, std::size_t last, float pixel_rad,
    std::span<std::uint32_t> kept) {
    std::size_t count = 0;
    for (std::size_t i = 3 * first; i < 3 * last; i += 3) {
        const std::uint32_t* corner = &draw.indices[i];
        const bool away = facing_of(draw, corner, pixel_rad) == Facing::Away;
        // Written in any case and counted when it stays: no branch to guess.
        kept[count] = corner[0];
        kept[count + 1] = corner[1];
        kept[count + 2] = corner[2];
        count += away ? 0 : 3;
    }
    return count;
}

} // namespace

scene::TriangleDraw front_facing(const GroundFrame& ground, double pixel_rad, std::vector<std::uint32_t>& kept) {
    const scene::TriangleDraw& draw = ground.all;
    const auto pixel = static_cast<float>(pixel_rad);
    kept.resize(draw.indices.size() + ground.shadow_indices.size());
    std::size_t count = 0;
    std::size_t next = 0;
    const auto keep_until = [&](std::size_t last) {
        count += remove_back_faces(draw, next, last, pixel, std::span(kept).subspan(count));
        next = last;
    };
    for (const ShadowPieces& shadow : ground.shadows) {
        keep_until(std::max<std::size_t>(next, std::size_t{shadow.triangle} + 1));
        std::ranges::copy(ground.shadow_indices.subspan(shadow.first, shadow.count),
            kept.begin() + static_cast<std::ptrdiff_t>(count));
        count += shadow.count;
    }
    keep_until(draw.indices.size() / 3);
    kept.resize(count);
    return {draw.vertices, kept};
}

scene::TriangleDraw front_facing_first(
    const scene::TriangleDraw& draw, double pixel_rad, std::vector<std::uint32_t>& kept, std::size_t& edge_on_indices) {
    kept.resize(draw.indices.size());
    std::size_t count = 0;
    std::size_t back = kept.size();
    for (std::size_t i = 0; i < draw.indices.size(); i += 3) {
        const std::uint32_t* corner = &draw.indices[i];
        const Facing facing = facing_of(draw, corner, static_cast<float>(pixel_rad));
        if (facing == Facing::Away) { continue; }
        std::size_t& place = facing == Facing::Towards ? count : back;
        place -= facing == Facing::Towards ? 0 : 3;
        std::copy_n(corner, 3, kept.begin() + static_cast<std::ptrdiff_t>(place));
        place += facing == Facing::Towards ? 3 : 0;
    }
    edge_on_indices = kept.size() - back;
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(count), kept.begin() + static_cast<std::ptrdiff_t>(back));
    return {draw.vertices, kept};
}

} // namespace octant::visuals::planning
