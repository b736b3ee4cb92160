#pragma once

#include "models/heights/gdal_session.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace octant::models::heights {

// Heights as map servers send them: coded in the colours of pictures, or as Cesium heightmaps. A tile whose path ends
// in ZOOM/COLUMN/ROW is placed by these numbers.

/// How heights are coded in red, green and blue of 8 bits.
enum class HeightEncoding {
    Terrarium, ///< (R * 256 + G + B / 256) - 32768 m (Mapzen, tilezen/joerd)
    Mapbox     ///< -10000 + (R * 65536 + G * 256 + B) * 0.1 m (Mapbox Terrain-RGB, MapTiler)
};

std::string_view name_of(HeightEncoding code);

/// By the name that --band may have: terrarium or mapbox.
std::optional<HeightEncoding> height_encoding_from_name(const std::string& name);

/// The rule by which a picture's colours are heights; nothing for a picture of anything else. It is told from samples
/// of all rows: all are heights that ground has, and neighbours' heights are close although the channel of the lower
/// digits jumps. Photographs have no such jumps.
std::optional<HeightEncoding> height_encoding_of(void* dataset);

/// The heights of such a picture in metres as one band, with its alpha band behind it if it has one. It reads `dataset`
/// anew by its name. Throws Error for a picture with fewer than three bands.
Dataset decoded_heights(const std::filesystem::path& file, void* dataset, HeightEncoding code);

/// A Cesium heightmap (.terrain of the format heightmap-1.0, also compressed by gzip); null for another file. Throws
/// Error for .terrain files of another format, such as quantized meshes.
Dataset open_cesium_heightmap(const std::string& file);

} // namespace octant::models::heights
