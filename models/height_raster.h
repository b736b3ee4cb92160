#pragma once

#include "models/gdal_session.h"
#include "models/height_grid.h"
#include "models/local_frame.h"

#include <filesystem>
#include <optional>

namespace octant::models {

/// A file of heights as GDAL gives it, turned so that row 0 is the south and column 0 the west.
struct HeightRaster {
    Dataset dataset;                ///< still open: owner of `system`
    HeightGrid grid;                ///< metres, NaN where the file has no data
    std::optional<GridFrame> frame; ///< nothing for a mere picture
    SystemHandle system = nullptr;  ///< null when the file names none
};

/// Throws Error unless the path is a readable, regular file with content on this computer.
void check_local_file(const std::filesystem::path& file);

/// Throws Error unless both are from 2 to largest_import_samples.
void check_import_size(const std::filesystem::path& file, int columns, int rows);

/// Throws Error unless the height is within the bounds of read_height_field.
void check_height(const std::filesystem::path& file, double height_m);

/// Reads the first band; the contract is read_height_field's. `picture_scale`: metres a unit of a
/// file without georeference.
HeightRaster
read_height_raster(const std::filesystem::path& file, double picture_scale, GdalSession& gdal);

} // namespace octant::models
