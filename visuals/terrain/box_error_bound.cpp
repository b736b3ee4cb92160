#include "visuals/terrain/box_error_bound.h"

#include <cmath>

namespace octant::visuals::terrain {

void BoxErrorBound::set_direction(const glm::dvec3& ahead, double corner_cos) {
    has_direction_ = ahead != glm::dvec3(0.0);
    ahead_ = {static_cast<float>(ahead.x * spacing_m_), static_cast<float>(ahead.y * spacing_m_)};
    const double level = std::hypot(ahead.x, ahead.y);
    const double tilt = level > 0.0 ? std::abs(ahead.z) / level : 0.0;
    aside_ = {
        static_cast<float>(-tilt * ahead.y * spacing_m_),
        static_cast<float>(tilt * ahead.x * spacing_m_)};
    level_ = static_cast<float>(level);
    corner_cos_squared_ = static_cast<float>(corner_cos * corner_cos);
    const double corner = std::sqrt(1.0 - corner_cos * corner_cos) / corner_cos;
    const double max_aside = std::abs(ahead.z) * corner;
    max_aside_squared_ = static_cast<float>(max_aside * max_aside);
    const double max_across = level + max_aside;
    near_factor_ = static_cast<float>(1.0 / (max_across * max_across));
}

} // namespace octant::visuals::terrain
