#pragma once

#include "models/heights/height_field.h"
#include "models/heights/import_options.h"
#include "models/heights/map_resampling.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
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

/// Heights of one or several rasters that form one ground, read in bands of rows; no raster is held as a whole, except
/// a plain PGM. Row 0 is the south, column 0 the west. For one thread without another GDAL session.
///
/// Rasters may have different systems, resolutions and positions: target_grid_for (map_resampling.h) chooses the
/// ground's grid. Where files overlap, the first named one that has data counts; gaps between files are without data.
/// Each of several files must be georeferenced.
class HeightSource {
public:
    /// Opens all files. Throws Error as read_height_field() above, and for files that do not fit together.
    HeightSource(std::vector<std::filesystem::path> files, const ImportOptions& options = {});
    ~HeightSource();
    HeightSource(HeightSource&&) = delete;
    HeightSource& operator=(HeightSource&&) = delete;
    HeightSource(const HeightSource&) = delete;
    HeightSource& operator=(const HeightSource&) = delete;

    int columns() const;
    int rows() const;
    double spacing_m() const;
    std::optional<GeoPosition> place() const;
    std::optional<CoordinateSystem> system() const; ///< nothing for ground without a place in any

    /// Name of the first file, and how many more there are.
    std::string name() const;

    /// The coordinate system of the first file by its own name; empty for a file that has none.
    std::string system_name() const;

    /// East and north sides of the finest file's cells at its middle, metres.
    glm::dvec2 cell_m() const;

    /// Messages about the files, in their order. Those about heights are complete after all heights have been read.
    std::vector<MapNote> notes() const;

    /// The number of samples without data in the files. Reads all samples. Throws Error.
    std::int64_t count_voids() const;

    /// Whether all heights are whole metres that fit 16 bits.
    bool has_integer_metres() const;

    /// The files' bilinear height at a position, metres east and north of the ground's centre; nothing without data.
    /// Not for files without georeference. Throws Error.
    std::optional<double> height_at(double x_m, double y_m) const;

    /// The vertical distance between a ground made of these samples and the files; nothing for files without
    /// georeference, whose samples are the ground's. Throws Error.
    std::optional<HeightDeviation> deviation_of(const GroundAt& ground) const;

    /// Heights of rows from `first_row` on, as many as fill the span, row after row from the south, NaN without data.
    /// Throws Error (damaged file, heights not believed).
    void read(int first_row, std::span<float> heights_m);

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

} // namespace octant::models::heights
