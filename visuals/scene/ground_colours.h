#pragma once

#include "models/height_field.h"
#include "visuals/scene/settings.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// Unit vector towards the sun, world axes. Azimuth clockwise from north.
glm::vec3 direction_to_sun(const Settings& settings);

/// Colour of bare light on a level surface would be 1: what reaches a surface from everywhere, and
/// from the sun times the cosine to it.
inline constexpr float ambient_light = 0.42F;
inline constexpr float sun_light = 0.78F;

/// Light on a surface: 1 would leave its colour as it is. Both unit vectors, world axes.
float light_on(const glm::vec3& normal, const glm::vec3& to_sun);

/// Colour of the ground at a sample before light falls on it, by height, slope and water level.
/// `normal`: of the sample, at full resolution.
glm::vec3 own_ground_colour(
    const models::HeightField& field,
    int column,
    int row,
    const glm::vec3& normal,
    const Settings& settings);

/// The ground as seen: one packed colour a sample (layout of the field: row 0 south, column 0
/// west), its own colour lit by the sun with the full-resolution
/// normals, so that the level of detail never changes the light.
std::vector<std::uint32_t>
ground_colours(const models::HeightField& field, const Settings& settings);

/// Mean of packed colours, linear parts 0..1.
glm::vec3 mean_colour(const std::vector<std::uint32_t>& colours);

} // namespace octant::visuals::scene
