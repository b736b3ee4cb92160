#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace octant::models::heights {

/// Samples of a text grid for which a word such as NA stands.
struct TextVoids {
    struct Run {
        std::int64_t first = 0; ///< samples count row after row from the north
        std::int64_t samples = 0;
    };

    std::vector<Run> runs; ///< in order, apart from each other
    std::int64_t samples = 0;
    std::string word;                ///< the first of them
    bool declares_no_number = false; ///< NODATA_value is a word: what GDAL makes of it is no value
    std::int64_t numbers_left = 0;   ///< behind the last sample

    /// Puts NaN in place of those samples among some in a row, from `first` on.
    void apply(std::int64_t first, std::span<double> raw) const;
};

/// Whether a driver of GDAL's reads text grids, of which it takes the front of a damaged number,
/// and 0 for what is no number at all.
bool is_text_grid(const std::string& driver);

/// Checks every number of a text grid that GDAL has opened by this driver. ESRI and GRASS grids may
/// have words without data (NA, NULL, ***) in place of heights, which are returned. Throws Error
/// "file:line: expected ..., got ..." for other words, damaged numbers, and a file that ends before
/// columns * rows of them.
TextVoids check_text_grid(
    const std::filesystem::path& file, const std::string& driver, int columns, int rows);

} // namespace octant::models::heights
