#pragma once

#include "visuals/nature/near_detail_view.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>

namespace octant::visuals::nature {

/// Which edges of near ground are halved. Places are in world axes with the eye subtracted, metres.

/// The ground below the eye, and places no nearer than this, metres.
inline constexpr float min_detail_distance_m = 3.0F;

inline constexpr int max_split_depth = 14; ///< of a triangle and its parts, one after the other

inline float squared_length(const glm::vec3& v) {
    return v.x * v.x + v.y * v.y + v.z * v.z;
}

/// Of an edge as seen from straight above.
inline float squared_plan_length_m2(const glm::vec3& a, const glm::vec3& b) {
    const float x = b.x - a.x;
    const float y = b.y - a.y;
    return x * x + y * y;
}

/// The square of how long an edge looks: its level length over the distance of its middle.
inline float squared_angular_size(const glm::vec3& a, const glm::vec3& b) {
    const float distance2 = std::max(squared_length(0.5F * (a + b)), min_detail_distance_m * min_detail_distance_m);
    return squared_plan_length_m2(a, b) / distance2;
}

/// Whether an edge is long enough to be halved, however long it looks.
inline bool is_splittable(const NearDetailView& view, const glm::vec3& a, const glm::vec3& b) {
    const float least = min_split_edge_ratio * static_cast<float>(view.spacing_m);
    return squared_plan_length_m2(a, b) > least * least;
}

/// Whether a triangle, and all that may be made of it, lies outside the frustum.
inline bool is_outside(const NearDetailView& view, const std::array<glm::vec3, 3>& triangle) {
    const auto vertical_offset_m = static_cast<float>(max_offset_ratio * view.spacing_m);
    return std::ranges::any_of(view.frustum_normals, [&](const glm::vec3& normal) {
        return normal != glm::vec3(0.0F) && glm::dot(normal, triangle[0]) < -vertical_offset_m &&
               glm::dot(normal, triangle[1]) < -vertical_offset_m && glm::dot(normal, triangle[2]) < -vertical_offset_m;
    });
}

} // namespace octant::visuals::nature
