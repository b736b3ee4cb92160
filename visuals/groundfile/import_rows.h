#pragma once

#include "models/heights/height_source.h"
#include "visuals/groundfile/ground_header.h"
#include "visuals/terrain/ground_layout.h"

#include <cstdint>
#include <span>

namespace octant::visuals::groundfile {

/// Updates the lowest and highest height in `progress` by some rows.
void scan_rows(
    models::heights::HeightSource& source, int first_row, int count, ImportProgress& progress);

/// Reads the rows that fill the span as the numbers to keep, void_value for samples without data.
/// If the source has whole metres, these are kept, and lowest and highest in `progress` are
/// updated; otherwise the numbers are those of shape_of the scanned heights. Counts voids. Throws
/// Error as the source does.
void read_rows(
    models::heights::HeightSource& source,
    int first_row,
    std::span<std::int16_t> numbers,
    ImportProgress& progress);

} // namespace octant::visuals::groundfile
