#pragma once

#include "models/heights/gdal_session.h"
#include "models/heights/height_field.h"
#include "models/heights/import_options.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::heights {

// Formats of map servers: heights encoded in the colours of images, and Cesium heightmaps. The path of a tile,
// ZOOM/COLUMN/ROW, gives its position.

/// How 8-bit red, green and blue encode a height.
enum class HeightEncoding {
    Terrarium, ///< (R * 256 + G + B / 256) - 32768 m (Mapzen, tilezen/joerd)
    Mapbox     ///< -10000 + (R * 65536 + G * 256 + B) * 0.1 m (Mapbox Terrain-RGB, MapTiler)
};

std::string_view name_of(HeightEncoding code);

/// The encoding by its name in --band: terrarium or mapbox.
std::optional<HeightEncoding> height_encoding_from_name(const std::string& name);

/// The encoding of an image that holds heights; nothing for other images. Samples of all rows decide: all must decode
/// to plausible heights, and heights of neighbours must be close although the channel of the lower digits jumps, which
/// it does not in photographs.
std::optional<HeightEncoding> height_encoding_of(void* dataset);

/// The heights of such an image, metres, as one band, followed by its alpha band if it has one. Opens `dataset` again
/// by its name. Throws Error for an image with fewer than three bands.
Dataset decoded_heights(const std::filesystem::path& file, void* dataset, HeightEncoding code);

/// A Cesium heightmap (.terrain of the format heightmap-1.0, also compressed by gzip); null for another file. Throws
/// Error for .terrain files of another format, such as quantized meshes.
Dataset open_cesium_heightmap(const std::string& file);

/// Metres per unit. Case, plurals, punctuation and following words ("m above mean sea level") do not matter. Nothing
/// for an unknown unit.
std::optional<double> metres_from_unit(std::string_view unit);

/// The band of a raster that holds heights, and what its raw numbers mean.
struct HeightBand {
    Dataset decoded;               ///< for heights encoded in colours; else null
    int number = 1;                ///< of the raster, or of `decoded`
    void* band = nullptr;          ///< GDALRasterBandH
    void* mask = nullptr;          ///< GDALRasterBandH, 0 = sample without data; null: none
    std::optional<double> no_data; ///< raw number that the file declares
    double scale_m = 1.0;
    double offset_m = 0.0;
    bool declares_unit = false; ///< whether the file names the unit of heights
    std::vector<MapNote> notes;
};

/// Whether a band's name means heights of the ground, and not their error, slope or heights of trees.
bool is_height_band_name(std::string_view name);

/// The raw number that a GDALRasterBandH declares for no data.
std::optional<double> declared_no_data(void* band);

/// Chooses the band of heights: the one that the options name; else that of a raster with one; heights that are coded
/// in colours by the rules of Terrarium or Mapbox; the first band whose name says elevation, height or the like; the
/// first one that does not say error, slope or the like. A note tells of the others unless the first band is the only
/// one that says heights. Throws Error for pictures, complex numbers, units that are no lengths, and bands that are not
/// there.
HeightBand height_band_of(const std::filesystem::path& file, void* dataset, const ImportOptions& options);

} // namespace octant::models::heights
