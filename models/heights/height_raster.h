#pragma once

#include "models/heights/gdal_session.h"
#include "models/heights/height_grid.h"
#include "models/heights/local_frame.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>

namespace octant::models::heights {

/// A file of heights as GDAL gives it, turned so that row 0 is the south and column 0 the west.
struct HeightRaster {
    Dataset dataset;                ///< still open: owner of `system`
    HeightGrid grid;                ///< metres, NaN where the file has no data
    std::optional<GridFrame> frame; ///< nothing for a file without georeference
    SystemHandle system = nullptr;  ///< null when the file names none
};

/// A file of heights, open to be read piece by piece: its first band and how raw numbers become
/// metres.
struct OpenRaster {
    Dataset dataset;
    void* band = nullptr; ///< GDALRasterBandH of the dataset
    std::optional<double> no_data;
    double scale_m = 1.0;
    double offset_m = 0.0;
    int columns = 0;
    int rows = 0;
    bool from_east = false;         ///< its lines run westward
    bool from_south = false;        ///< its first line is the southernmost
    bool whole_metres = false;      ///< its numbers are metres that fit 16 bits
    std::optional<GridFrame> frame; ///< nothing for a file without georeference
    SystemHandle system = nullptr;  ///< owned by the dataset; null when the file names none
};

/// Consecutive rows of a grid, counted from the south.
struct RowBand {
    int first = 0;
    int count = 0;
};

/// Stands for a sample without data among whole metres.
inline constexpr std::int16_t void_metres = std::numeric_limits<std::int16_t>::min();

/// Throws Error unless the path is a readable, regular file with content on this computer.
void check_local_file(const std::filesystem::path& file);

/// Throws Error unless both are from 2 to largest_import_samples.
void check_import_size(const std::filesystem::path& file, int columns, int rows);

/// Throws Error unless the height is within the bounds of read_height_field.
void check_height(const std::filesystem::path& file, double height_m);

/// Opens a file; the contract is read_height_field's, but for the size, which is not checked.
OpenRaster
open_height_raster(const std::filesystem::path& file, double picture_scale, GdalSession& gdal);

/// Heights of rows, row after row from the south, NaN without data. Throws Error as
/// read_height_field.
void read_heights(
    const std::filesystem::path& file,
    const OpenRaster& raster,
    RowBand rows,
    std::span<float> heights_m,
    const GdalSession& gdal);

/// As read_heights, for a raster of whole metres (asserted); void_metres without data.
void read_whole_metres(
    const std::filesystem::path& file,
    const OpenRaster& raster,
    RowBand rows,
    std::span<std::int16_t> heights_m,
    const GdalSession& gdal);

/// Reads the first band; the contract is read_height_field's. `picture_scale`: metres a unit of a
/// file without georeference.
HeightRaster
read_height_raster(const std::filesystem::path& file, double picture_scale, GdalSession& gdal);

} // namespace octant::models::heights
