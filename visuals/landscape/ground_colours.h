#pragma once

#include "models/heights/height_field.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/scene/settings.h"
#include "visuals/terrain/ground_query.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace octant::visuals::landscape {

/// A sample of the ground; its normal is from the heights `step` samples away on each side, fewer at the border: 1 for
/// the full-resolution ground, else the mean slope of so wide a surrounding.
TerrainPoint ground_point(const terrain::GroundSamples& ground, int column, int row, int step);

/// The ground as seen: one packed colour a sample (layout of the field: row 0 south, column 0 west), coloured by
/// height, slope and water level and lit by the sun with the full-resolution normals, so that the level of detail never
/// changes the light.
std::vector<std::uint32_t> ground_colours(
    const models::heights::HeightField& field, const scene::AirSettings& settings);

/// The sample nearest to a place, world axes, with the mean slope over about `footprint_m`.
TerrainPoint nearest_point(const terrain::GroundSamples& ground, const glm::dvec2& at_m, double footprint_m);

/// Its colour as the mean over about `footprint_m`.
glm::vec3 nearest_colour(
    const terrain::GroundSamples& ground, const GroundPalette& palette, const glm::dvec2& at_m, double footprint_m);

/// Mean of packed colours, display values 0..1.
glm::vec3 mean_colour(const std::vector<std::uint32_t>& colours);

} // namespace octant::visuals::landscape
