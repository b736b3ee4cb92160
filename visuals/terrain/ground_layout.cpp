// Computes the offsets of ground_layout.h. Tiles keep what a mesh looks at together in few pages,
// so that a mapped file is read in large pieces.
#include "visuals/terrain/ground_layout.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace octant::visuals::terrain {

namespace {

constexpr std::size_t node_bytes = 9; ///< Three heights of two bytes and three errors of one byte.

std::size_t rounded_up(std::size_t bytes, std::size_t multiple) {
    return (bytes + multiple - 1) / multiple * multiple;
}

int rounded_up_quotient(int dividend, int divisor) {
    return (dividend + divisor - 1) / divisor;
}

} // namespace

GroundLayout::GroundLayout(int columns, int rows) {
    assert(columns >= 2 && rows >= 2 && columns <= 65536 && rows <= 65536);
    const int longest = std::max({columns, rows, 3}) - 1;
    const int count = static_cast<int>(std::bit_width(static_cast<unsigned>(longest - 1)));
    std::size_t end = 4 * sizeof(std::int16_t);
    for (int index = 0; index < count; ++index) {
        Level& level = levels_.emplace_back();
        level.edge = 1 << (count - index);
        level.columns = rounded_up_quotient(columns - 1, level.edge);
        level.rows = rounded_up_quotient(rows - 1, level.edge);
        const auto widest = static_cast<unsigned>(std::max(level.columns, level.rows));
        level.tile_shift =
            std::countr_zero(std::min(std::bit_ceil(widest), static_cast<unsigned>(tile_edge)));
        level.tiles_across = rounded_up_quotient(level.columns, 1 << level.tile_shift);
        level.tiles_up = rounded_up_quotient(level.rows, 1 << level.tile_shift);
        level.tile_nodes = std::size_t{1} << static_cast<unsigned>(2 * level.tile_shift);
        level.tile_bytes = rounded_up(node_bytes * level.tile_nodes, 2);
        if (index == 0 || level.edge >= finest_range_edge) {
            range_level_ = index;
            level.ranges = end;
            end += sizeof(HeightRange) * static_cast<std::size_t>(level.columns) *
                   static_cast<std::size_t>(level.rows);
        }
    }
    for (Level& level : levels_) {
        const auto across = static_cast<std::size_t>(level.columns);
        const auto up = static_cast<std::size_t>(level.rows);
        level.north_heights = end;
        level.east_heights = level.north_heights + 2 * across;
        level.north_errors = level.east_heights + 2 * up;
        level.east_errors = level.north_errors + across;
        end = rounded_up(level.east_errors + up, 2);
    }
    end = rounded_up(end, page_bytes);
    for (Level& level : levels_) {
        level.first_tile = end;
        end += level.tile_bytes * static_cast<std::size_t>(level.tiles_across) *
               static_cast<std::size_t>(level.tiles_up);
    }
    total_bytes_ = end;
}

} // namespace octant::visuals::terrain
