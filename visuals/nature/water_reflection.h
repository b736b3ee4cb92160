#pragma once

#include "visuals/nature/daylight.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace octant::visuals::nature {

/// What a slightly rough sea shows of the sky and of the sun, by the direction in which it is seen.
class WaterReflection {
public:
    explicit WaterReflection(const Daylight& day);

    /// Display values of a place: `own` is what comes out of the water itself, `from_eye` the way from the eye to it,
    /// of any length, downwards.
    glm::vec3 shaded_colour(const glm::vec3& own, const glm::vec3& from_eye) const;

private:
    static constexpr std::size_t heights = 9; ///< of the sky, evenly in the sine of elevation

    glm::vec3 sky(const glm::vec3& direction) const;

    glm::vec3 to_sun_;
    glm::vec2 horizontal_to_sun_;
    glm::vec3 sun_;
    std::array<glm::vec3, heights> sky_away_{};
    std::array<glm::vec3, heights> sky_sunward_{};
};

} // namespace octant::visuals::nature
