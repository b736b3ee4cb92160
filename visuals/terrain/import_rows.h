#pragma once

#include "models/heights/height_source.h"
#include "visuals/terrain/ground_header.h"

#include <cstdint>
#include <span>

namespace octant::visuals::terrain {

/// Lets the progress know the lowest and highest of some rows.
void scan_rows(
    models::heights::HeightSource& source, int first_row, int count, GroundProgress& progress);

/// The numbers to keep of the rows that fill the span, void_number without data: whole metres
/// where the source has them, whose lowest and highest the progress is told; else by shape_of the
/// scanned ones. Counts voids. Throws Error as the source.
void read_rows(
    models::heights::HeightSource& source,
    int first_row,
    std::span<std::int16_t> numbers,
    GroundProgress& progress);

} // namespace octant::visuals::terrain
