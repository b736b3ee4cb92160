#pragma once

#include "models/heights/gdal_session.h"
#include "models/heights/height_band.h"
#include "models/heights/height_voids.h"
#include "models/heights/import_options.h"
#include "models/heights/local_frame.h"
#include "models/heights/text_grid.h"

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace octant::models::heights {

/// A file of heights, open to be read piece by piece: its band of heights and how raw numbers become metres. Row 0 is
/// the south and column 0 the west, where it is upright.
struct HeightRaster : HeightBand {
    std::vector<Dataset> datasets;        ///< the file's, then those derived from it; the last one owns `band`
    std::vector<double> user_void_values; ///< raw numbers of the options
    TextVoids text_voids;                 ///< of a text grid
    /// Found by the first read that meets a doubtful number, from all samples.
    mutable std::optional<UndeclaredVoids> undeclared;
    int columns = 0;
    int rows = 0;
    bool rows_run_west = false;       ///< its lines run westward
    bool first_row_is_south = false;  ///< its first line is the southernmost
    bool has_integer_metres = false;  ///< its numbers are metres that fit 16 bits
    std::optional<GridTransform> map; ///< nothing for a file without georeference
    Ellipsoid ellipsoid;              ///< of its system; WGS 84 without one
    SpatialReference system;          ///< null where lengths are metres without a place on the earth
};

/// A rectangle of a grid.
struct GridWindow {
    int first_column = 0;
    int columns = 0;
    int first_row = 0; ///< counted from the south
    int rows = 0;
};

/// Throws Error unless the height is within the bounds of import_options.h for this body. The error names the options
/// that can help: --void with the raw number, and --height-scale unless the file names the unit of its heights.
void check_height(const std::filesystem::path& file, double height_m, double raw, bool declares_unit,
    const Ellipsoid& ellipsoid = {});

/// Opens a file with any of GDAL's drivers. The contract is that of read_height_field (height_source.h), except that
/// the size is not checked.
HeightRaster open_height_raster(const std::filesystem::path& file, const ImportOptions& options, GdalSession& gdal);

/// All messages about a raster; complete after all heights have been read.
std::vector<MapNote> notes_of(const std::filesystem::path& file, const HeightRaster& raster);

/// Heights of a window of the raster, row after row from the south, NaN without data. Throws Error as
/// read_height_field.
void read_heights(const std::filesystem::path& file, const HeightRaster& raster, const GridWindow& window,
    std::span<float> heights_m, const GdalSession& gdal);

/// The numbers that the file stores for a window, row after row from the south; NaN where there is no data by the
/// file's word or the options'. Throws Error as read_height_field.
void read_raw(const std::filesystem::path& file, const HeightRaster& raster, const GridWindow& window,
    std::span<double> raw, const GdalSession& gdal);

/// Whether a stored number equals a number of --void, `mark`, apart from rounding to float.
bool is_same_raw(double raw, double mark);

} // namespace octant::models::heights
