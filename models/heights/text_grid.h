#pragma once

#include "models/heights/gdal_session.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace octant::models::heights {

/// The samples of a text grid that are words such as NA instead of numbers.
struct TextVoids {
    std::vector<bool> are_void; ///< one a sample, row after row from the north, up to the last void
    std::int64_t samples = 0;
    std::string word;                ///< the first of them
    bool declares_no_number = false; ///< NODATA_value is a word, thus GDAL's number for it is meaningless
    std::int64_t numbers_left = 0;   ///< how many numbers follow the last sample

    /// Replaces these samples by NaN in consecutive samples that begin with number `first`.
    void apply(std::int64_t first, std::span<double> raw) const;
};

/// Opens an ESRI or GRASS text grid whose first height is a word without data, such as NA. GDAL alone takes that for a
/// part of the header: it refuses the file or loses the first row. The dataset has 0 there. Null for all other files.
/// Throws Error for a first height that is neither a number nor such a word.
Dataset open_grid_that_begins_with_word(const std::filesystem::path& file);

/// Opens a plain (text) PGM, which GDAL cannot read, as a dataset in memory of 16-bit grey values. Null for all other
/// files. Throws Error "file:line: expected ..., got ...", for the size before any value is read (check_size).
/// Source: Netpbm, pgm(5), "Plain PGM": P2, width, height, largest value, then values from the top left, separated by
/// white space; '#' starts a comment that runs to the end of its line. Deviations: none.
Dataset open_plain_pgm(const std::filesystem::path& file);

/// Whether a driver of GDAL's reads text grids, of which it takes the front of a damaged number, and 0 for what is no
/// number at all.
bool is_text_grid(const std::string& driver);

/// Checks every number of a text grid that GDAL has opened by this driver. ESRI and GRASS grids may have words without
/// data (NA, NULL, ***) in place of heights, which are returned. Throws Error "file:line: expected ..., got ..." for
/// other words, damaged numbers, and a file that ends before columns * rows of them. Points may have a first line of
/// names, which has no numbers. Memory: a bit a sample where there are such words.
TextVoids check_text_grid(const std::filesystem::path& file, const std::string& driver, int columns, int rows);

} // namespace octant::models::heights
