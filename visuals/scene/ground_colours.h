#pragma once

#include "models/height_field.h"
#include "visuals/scene/ground_palette.h"
#include "visuals/scene/settings.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// A sample of the field at full resolution.
GroundPoint ground_point(const models::HeightField& field, int column, int row);

/// The ground as seen: one packed colour a sample (layout of the field: row 0 south, column 0
/// west), coloured by height, slope and water level and lit by the sun with the full-resolution
/// normals, so that the level of detail never changes the light.
std::vector<std::uint32_t>
ground_colours(const models::HeightField& field, const Settings& settings);

/// Mean of packed colours, linear parts 0..1.
glm::vec3 mean_colour(const std::vector<std::uint32_t>& colours);

} // namespace octant::visuals::scene
