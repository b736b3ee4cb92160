#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace octant::visuals::groundfile {

/// Stands for a sample without data among a field's numbers.
inline constexpr std::int16_t void_value = std::numeric_limits<std::int16_t>::min();

/// Gives every void of a field (row after row) a height that runs smoothly from rim to rim, rounded
/// to a whole number. At least one sample must be known; known samples stay as they are. Up to four
/// million samples are filled in one piece (models/heights/height_voids.h). Of a larger field, a
/// coarser one of block means is filled first, and from it the voids are smoothed piece by piece.
/// Memory: at most 80 MB beside the numbers.
void fill_integer_voids(std::span<std::int16_t> numbers, int columns, int rows);

} // namespace octant::visuals::groundfile
