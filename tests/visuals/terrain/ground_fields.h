#pragma once

#include "models/heights/height_field.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <filesystem>
#include <span>

namespace octant::visuals::terrain {

/// Rough ground of whole metres, the same for the same seed.
models::heights::HeightField
rough_field(int columns, int rows, unsigned seed = 1, int range_m = 900);

/// Writes whole metres, row after row from the north, as an uncompressed GeoTIFF without coordinate
/// system; `corner_m`: its north-western corner.
void write_geotiff(
    const std::filesystem::path& file,
    int columns,
    std::span<const std::int16_t> heights_m,
    double spacing_m,
    glm::dvec2 corner_m);

} // namespace octant::visuals::terrain
