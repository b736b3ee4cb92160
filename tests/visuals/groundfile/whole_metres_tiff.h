#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <filesystem>
#include <span>

namespace octant::visuals::groundfile {

/// Writes whole metres, row after row from the north, as an uncompressed GeoTIFF without coordinate system; `corner_m`:
/// its north-western corner.
void write_geotiff(const std::filesystem::path& file, int columns, std::span<const std::int16_t> heights_m,
    double spacing_m, glm::dvec2 corner_m);

} // namespace octant::visuals::groundfile
