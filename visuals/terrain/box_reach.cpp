#include "visuals/terrain/box_reach.h"

#include <cmath>

namespace octant::visuals::terrain {

void BoxReach::look(const glm::dvec3& ahead, double corner_cos) {
    in_picture_ = ahead != glm::dvec3(0.0);
    ahead_east_m_ = static_cast<float>(ahead.x * spacing_m_);
    ahead_north_m_ = static_cast<float>(ahead.y * spacing_m_);
    tilt_m2_ = static_cast<float>(ahead.z * ahead.z) * spacing_squared_m2_;
    corner_cos_squared_ = static_cast<float>(corner_cos * corner_cos);
    const double level = std::hypot(ahead.x, ahead.y);
    const double most_across =
        level + std::abs(ahead.z) * std::sqrt(1.0 - corner_cos * corner_cos) / corner_cos;
    near_factor_ = static_cast<float>(1.0 / (most_across * most_across));
}

} // namespace octant::visuals::terrain
