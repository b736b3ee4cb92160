#pragma once

#include "visuals/scene/settings.h"

#include <glm/vec3.hpp>

namespace octant::visuals::scene {

/// Unit vector towards the sun, world axes. Azimuth clockwise from north.
glm::vec3 direction_to_sun(const AirSettings& settings);

/// Colour of bare light on a level surface would be 1: what reaches a surface from everywhere, and
/// from the sun times the cosine to it.
inline constexpr float ambient_light = 0.42F;
inline constexpr float sun_light = 0.78F;

/// Light on a surface: 1 would leave its colour as it is. Both unit vectors, world axes.
float light_on(const glm::vec3& normal, const glm::vec3& to_sun);

/// Whether ground has the same colours under both: its sun, water and palette.
bool same_colours(const AirSettings& a, const AirSettings& b);

/// A place on the ground.
struct GroundPoint {
    float east_m = 0.0F;   ///< of the field's south-west corner
    float north_m = 0.0F;  ///< of the field's south-west corner
    float height_m = 0.0F; ///< above datum
    glm::vec3 normal{0.0F, 0.0F, 1.0F};
};

/// Which colour ground has by place, height and slope: the same everywhere and for every field.
class GroundPalette {
public:
    explicit GroundPalette(const AirSettings& settings);

    /// Own colour, display values 0..1. Features smaller than `footprint_m` are seen as their mean:
    /// the size of what one colour stands for, metres.
    glm::vec3 own(const GroundPoint& point, float footprint_m) const;

    /// The colour as own() gives it, lit by the sun, display values.
    glm::vec3 lit(const GroundPoint& point, float footprint_m) const;

private:
    glm::vec3 to_sun_;
    float water_m_;
    bool arid_;
};

} // namespace octant::visuals::scene
