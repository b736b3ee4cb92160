#pragma once

#include "visuals/nature/fine_view.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>

namespace octant::visuals::nature {

/// Which edges of near ground are halved. Places are in world axes with the eye subtracted, metres.

/// The ground below the eye, and places no nearer than this, metres.
inline constexpr float nearest_fine_m = 3.0F;

inline constexpr int max_halvings = 14; ///< of a triangle and its parts, one after the other

inline float squared(const glm::vec3& v) {
    return v.x * v.x + v.y * v.y + v.z * v.z;
}

/// Of an edge as seen from straight above.
inline float level_length2(const glm::vec3& a, const glm::vec3& b) {
    const float x = b.x - a.x;
    const float y = b.y - a.y;
    return x * x + y * y;
}

/// The square of how long an edge looks: its level length over the distance of its middle.
inline float look2(const glm::vec3& a, const glm::vec3& b) {
    const float distance2 = std::max(squared(0.5F * (a + b)), nearest_fine_m * nearest_fine_m);
    return level_length2(a, b) / distance2;
}

/// Whether an edge is long enough to be halved, however long it looks.
inline bool may_be_halved(const FineView& view, const glm::vec3& a, const glm::vec3& b) {
    const float least = min_fine_edge * static_cast<float>(view.spacing_m);
    return level_length2(a, b) > least * least;
}

/// Whether a triangle, and all that may be made of it, lies outside the frustum.
inline bool is_outside(const FineView& view, const std::array<glm::vec3, 3>& triangle) {
    const auto moved_m = static_cast<float>(max_fine_move * view.spacing_m);
    return std::ranges::any_of(view.frustum_normals, [&](const glm::vec3& normal) {
        return normal != glm::vec3(0.0F) && glm::dot(normal, triangle[0]) < -moved_m &&
               glm::dot(normal, triangle[1]) < -moved_m && glm::dot(normal, triangle[2]) < -moved_m;
    });
}

} // namespace octant::visuals::nature
