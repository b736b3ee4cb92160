#pragma once

#include "models/heights/height_field.h"
#include "models/heights/import_options.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::models::heights {

/// Heights of one or several files that form one ground, read in bands of rows: none is held as a
/// whole. Row 0 is the south, column 0 the west. For one thread, on which no other GDAL session
/// lives.
///
/// Several files have the same coordinate system and spacing, their samples lie on one grid, and
/// each knows its place. Where files overlap, the first named that has data counts; gaps between
/// them are without data.
///
/// What read_height_field would have to resample (degrees, oblong cells, a projection untrue to
/// scale) is read by it, as a whole, if it is a single file within its size limit; else an Error
/// names the call of gdalwarp that makes a file which can be streamed. So is a plain PGM.
class HeightSource {
public:
    static constexpr int largest_samples = 65536; ///< of width and of height

    /// Opens all files. Throws Error as read_height_field, and for files that do not fit together.
    HeightSource(std::vector<std::filesystem::path> files, const ImportOptions& options = {});
    ~HeightSource();
    HeightSource(HeightSource&&) = delete;
    HeightSource& operator=(HeightSource&&) = delete;
    HeightSource(const HeightSource&) = delete;
    HeightSource& operator=(const HeightSource&) = delete;

    int columns() const;
    int rows() const;
    double spacing_m() const;
    std::optional<GeoPlace> place() const;
    std::optional<MapSystem> system() const; ///< nothing for ground without a place in any

    /// Name of the first file, and how many more there are.
    std::string name() const;

    /// How many voids were filled before heights are read.
    std::int64_t filled_voids() const;

    /// Whether all heights are whole metres that fit 16 bits.
    bool whole_metres() const;

    /// Heights of rows from `first_row` on, as many as fill the span, row after row from the south,
    /// NaN without data. Throws Error (damaged file, heights not believed).
    void read(int first_row, std::span<float> heights_m);

    /// Whole metres, where whole_metres() (asserted); void_metres (height_raster.h) without data.
    void read(int first_row, std::span<std::int16_t> heights_m);

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

} // namespace octant::models::heights
