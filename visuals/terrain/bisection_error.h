#pragma once

#include "visuals/terrain/stored_heights.h"

#include <cstddef>
#include <cstdint>

namespace octant::visuals::terrain {

/// A diamond: two triangles of the longest-edge bisection that share their hypotenuse. The sample in the middle of the
/// hypotenuse splits both.
enum class Diamond : std::uint8_t {
    Rising,  ///< A square node, cut from its south-west corner to its north-east one.
    Falling, ///< A square node, cut from its north-west corner to its south-east one.
    Lying,   ///< A square on its corner, cut from west to east.
    Upright  ///< A square on its corner, cut from south to north.
};

/// A row of samples, each the middle of a diamond of the same size.
struct DiamondRow {
    const std::int16_t* first_middle = nullptr;
    std::ptrdiff_t pitch = 0; ///< How many numbers one row of the field is from the next.
    /// The distance from a middle to the ends of its hypotenuse along an axis, in samples: a power of two from 1 to 16.
    /// The next middle is twice as far away.
    int half = 1;
    int count = 0;
};

/// For each diamond of a row, the largest vertical distance of the samples inside its two triangles and on the
/// hypotenuse from the planes through the triangles' corners, in units of the numbers. The legs are left out, because
/// they are the hypotenuses of diamonds half as wide. Exact.
void diamond_errors(const DiamondRow& row, Diamond diamond, float* errors);

/// The same for a row of nodes whose diagonals alternate, starting with `first` (Rising or Falling).
void node_errors(const DiamondRow& row, Diamond first, float* errors);

/// The middle of a diamond anywhere in a field, in samples. Only samples `stride` apart are looked at.
struct DiamondPosition {
    int column = 0;
    int row = 0;
    int half = 1;
    int stride = 1;
};

/// The same for a single diamond anywhere in the padded square (StoredHeights::padded_number), legs included: what lies
/// beyond the field does not count, but for the next samples `stride` apart. Triangles beyond the field's south and
/// west sides do not count.
float padded_error(const StoredHeights& heights, const DiamondPosition& place, Diamond diamond);

} // namespace octant::visuals::terrain
