#pragma once

#include "models/heights/height_field.h"
#include "models/heights/import_options.h"

#include <filesystem>

namespace octant::models::heights {

/// Reads a height field: GeoTIFF, SRTM .hgt, USGS DEM, PNG (8 and 16 bit), PGM (binary and plain)
/// or ASCII grid. Nothing else is opened, no network is used and nothing is written.
///
/// Ground: a file in degrees (or in a projection whose scale is wrong by more than 1 % there) is
/// resampled bilinearly to a transverse Mercator grid about its centre, spaced by the geometric
/// mean of its east and north spacing and cropped to the largest upright rectangle without missing
/// corners. A projected file in metres or feet is taken as it is, its grid north as north;
/// oblong cells are resampled to square ones. A file with a pixel size but no coordinate system
/// counts as metres. A file with neither takes both options. `place` is set when a coordinate
/// system is known.
///
/// Heights: of the first band, scale, offset and feet applied. No data are NaN, infinities,
/// magnitudes from 1e30, the file's declared value and, where none is declared, -32768, -32767 and
/// -9999. They are filled smoothly and counted in `filled_voids`.
///
/// Memory: 4 bytes a sample, 8 while resampling; about 11 more a void while filling; for a plain
/// PGM also the file.
///
/// Throws Error "file: expected ..., got ..." for everything else: no readable file, a damaged one,
/// a colour picture, a rotated grid, only voids, heights outside the bounds of import_options.h,
/// fewer than 2 x 2 or more than 20,000 x 20,000 samples, ground wider than 1,000 km.
HeightField read_height_field(const std::filesystem::path& file, const ImportOptions& options = {});

} // namespace octant::models::heights
