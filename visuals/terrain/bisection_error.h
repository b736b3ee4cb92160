#pragma once

#include "visuals/terrain/stored_heights.h"

#include <cstddef>
#include <cstdint>

namespace octant::visuals::terrain {

/// Which two triangles lie hypotenuse to hypotenuse about a sample.
enum class Diamond : std::uint8_t {
    Rising,  ///< a node, cut from its south-west corner to its north-east
    Falling, ///< a node, cut from its north-west corner to its south-east
    Lying,   ///< on its corner, cut from west to east
    Upright  ///< on its corner, cut from south to north
};

/// A row of samples, each the middle of a diamond.
struct DiamondRow {
    const std::int16_t* first_middle = nullptr;
    std::ptrdiff_t pitch = 0; ///< numbers from row to row
    int half = 1;             ///< from a middle to its hypotenuse's ends along an axis: 1 to 16;
                              ///< the next middle is twice as far
    int count = 0;
};

/// How far the samples inside the two triangles of each diamond, and on their hypotenuse, lie above
/// or below the planes through the triangles' corners at most, in steps of the numbers. The legs
/// are left out: they are the hypotenuses of diamonds half as wide. Exact.
void diamond_errors(const DiamondRow& row, Diamond diamond, float* errors);

/// The same for rows of nodes whose diagonals alternate, `first` and then the other.
void node_errors(const DiamondRow& row, Diamond first, float* errors);

/// The same for one diamond of a field anywhere, legs included, its corners where the field's last
/// column and row are repeated in place. Triangles without area and those beyond the field's south
/// and west do not count. Samples are looked at `stride` apart.
struct DiamondPlace {
    int column = 0; ///< of its middle
    int row = 0;
    int half = 1;
    int stride = 1;
};

float clamped_error(const StoredHeights& heights, const DiamondPlace& place, Diamond diamond);

} // namespace octant::visuals::terrain
