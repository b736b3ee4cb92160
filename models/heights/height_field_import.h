#pragma once

#include "models/heights/height_field.h"
#include "models/heights/import_options.h"

#include <filesystem>
#include <vector>

namespace octant::models::heights {

/// Reads a height field from any raster that GDAL knows, or from a plain PGM. Uses no network and writes nothing.
///
/// Grid: as target_grid_for (map_resampling.h) chooses it. A projected file in metres or feet with square cells is
/// taken sample by sample, its grid north as north; degrees and projections that are not true to scale are resampled. A
/// file with a pixel size but no coordinate system takes the option, else WGS 84 where its axes are in degrees, else
/// counts as metres. A file with neither takes the option's spacing. `place` is set when a coordinate system is known.
/// A raster placed by control points is laid on a grid first.
///
/// Heights: of the band that height_band_of chooses, with scale, offset and unit (of the band, else of the system, else
/// of the options) applied. Samples without data are NaN, infinities, the value that the file declares, those of the
/// options, masked or transparent samples, words of text grids (text_grid.h) and undeclared values that VoidDetector
/// finds. They are filled smoothly and counted in `filled_voids`. `notes` reports each guess.
///
/// Memory: 4 bytes a sample; about 11 more a void while filling; for a plain PGM also the file.
///
/// Throws Error "file: expected ..., got ..." for everything else: no readable file, a damaged one, a colour picture,
/// one of several sub-datasets, only voids, heights outside the bounds of import_options.h, fewer than 2 x 2 or more
/// than 20,000 x 20,000 samples, ground wider than 1,000 km that must be resampled.
HeightField read_height_field(const std::filesystem::path& file, const ImportOptions& options = {});

/// Reads several files that form one ground (height_source.h).
HeightField read_height_field(const std::vector<std::filesystem::path>& files, const ImportOptions& options = {});

/// Throws Error if the options name an unknown coordinate system, even for files that need none.
void check_coordinate_system(const ImportOptions& options);

} // namespace octant::models::heights
