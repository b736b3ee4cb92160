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
/// in colours by the rules of Terrarium or Mapbox tiles, whose path ZOOM/COLUMN/ROW gives their position where nothing
/// else does; the first band whose name says elevation, height or the like; the
/// first one that does not say error, slope or the like. A note tells of the others unless the first band is the only
/// one that says heights. Throws Error for pictures, complex numbers, units that are no lengths, and bands that are not
/// there.
HeightBand height_band_of(const std::filesystem::path& file, void* dataset, const ImportOptions& options);

} // namespace octant::models::heights
