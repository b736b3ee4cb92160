// Reflection by angle: C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering",
// 1994. The sun's glitter: facets whose slopes are spread as C. Cox and W. Munk measured them,
// "Measurement of the Roughness of the Sea Surface from Photographs of the Sun's Glitter", 1954, for a light wind.
#include "visuals/nature/water_reflection.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::nature {

namespace {

constexpr float straight_down = 0.02F; ///< share of light that is reflected
constexpr float slope_variance = 0.02F;
/// Waves that face the eye hide those behind: at grazing angles less is reflected than off glass.
constexpr float max_reflected = 0.75F;
constexpr float glitter = 0.9F; ///< of the sun's colour in the middle of its path

} // namespace

WaterReflection::WaterReflection(const Daylight& day)
    : to_sun_(day.to_sun()), horizontal_to_sun_(day.horizontal_to_sun()), sun_(day.disc()) {
    const glm::dvec2 sunward =
        glm::length(day.horizontal_to_sun()) > 0.0 ? day.horizontal_to_sun() : glm::dvec2(1.0, 0.0);
    for (std::size_t i = 0; i < heights; ++i) {
        const double up = static_cast<double>(i) / (heights - 1);
        const double level = std::sqrt(1.0 - up * up);
        sky_sunward_[i] = day.sky(glm::dvec3(sunward * level, up));
        sky_away_[i] = day.sky(glm::dvec3(-sunward * level, up));
    }
}

glm::vec3 WaterReflection::sky(const glm::vec3& direction) const {
    const float place = std::clamp(direction.z, 0.0F, 1.0F) * (heights - 1);
    const auto low = std::min(static_cast<std::size_t>(place), heights - 2);
    const float part = place - static_cast<float>(low);
    const float towards = std::max(glm::dot(glm::vec2(direction), horizontal_to_sun_), 0.0F);
    return glm::mix(glm::mix(sky_away_[low], sky_away_[low + 1], part),
        glm::mix(sky_sunward_[low], sky_sunward_[low + 1], part), towards * towards);
}

glm::vec3 WaterReflection::shaded_colour(const glm::vec3& own, const glm::vec3& from_eye) const {
    const glm::vec3 way = glm::normalize(from_eye);
    const float down = std::clamp(-way.z, 0.0F, 1.0F);
    const float left = 1.0F - down;
    const float reflected = straight_down + (max_reflected - straight_down) * left * left * left * left * left;
    const glm::vec3 facet = to_sun_ - way;
    const float across2 = facet.x * facet.x + facet.y * facet.y;
    const float slope2 = across2 / std::max(facet.z * facet.z, 1e-6F);
    const float sparkle = std::exp(-slope2 / slope_variance) * glitter;
    const glm::vec3 colour = glm::mix(own, sky({way.x, way.y, std::max(-way.z, 0.02F)}), reflected) + sun_ * sparkle;
    return glm::min(colour, glm::vec3(1.0F));
}

} // namespace octant::visuals::nature
