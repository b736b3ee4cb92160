// Computes the offsets of ground_layout.h. Tiles keep what a mesh looks at together in few pages, so that a mapped file
// is read in large pieces.
#include "visuals/terrain/ground_layout.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace octant::visuals::terrain {

namespace {

constexpr std::size_t parts_of_node = 3;
constexpr std::size_t height_bytes = 2;

std::size_t rounded_up(std::size_t bytes, std::size_t multiple) { return (bytes + multiple - 1) / multiple * multiple; }

int rounded_up_quotient(int dividend, int divisor) { return (dividend + divisor - 1) / divisor; }

} // namespace

ErrorCodes codes_of(const GroundShape& shape) {
    return shape.has_unit_codes ? ErrorCodes::for_height_unit(shape.height_unit_m) : ErrorCodes::legacy();
}

GroundLayout::GroundLayout(int columns, int rows, bool has_both_margins) : has_both_margins_(has_both_margins) {
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
        level.tile_shift = std::countr_zero(std::min(std::bit_ceil(widest), static_cast<unsigned>(tile_edge)));
        level.tiles_across = rounded_up_quotient(level.columns, 1 << level.tile_shift);
        level.tiles_up = rounded_up_quotient(level.rows, 1 << level.tile_shift);
        level.tile_nodes = std::size_t{1} << static_cast<unsigned>(2 * level.tile_shift);
        place_errors(level, index + 1 == count);
        if (index == 0 || level.edge >= finest_range_edge) {
            range_level_ = index;
            level.ranges = end;
            end += sizeof(HeightRange) * static_cast<std::size_t>(level.columns) * static_cast<std::size_t>(level.rows);
        }
    }
    for (Level& level : levels_) {
        const auto across = static_cast<std::size_t>(level.columns);
        const auto up = static_cast<std::size_t>(level.rows);
        level.north_heights = end;
        level.east_heights = level.north_heights + 2 * across;
        end = level.east_heights + 2 * up;
        for (std::size_t morph_margin = 0; morph_margin < (has_both_margins ? 2 : 1); ++morph_margin) {
            std::fill(level.north_errors.begin() + morph_margin, level.north_errors.end(), end);
            std::fill(level.east_errors.begin() + morph_margin, level.east_errors.end(), end + across);
            end += across + up;
        }
        end = rounded_up(end, 2);
    }
    end = rounded_up(end, page_bytes);
    for (Level& level : levels_) {
        level.first_tile = end;
        end +=
            level.tile_bytes * static_cast<std::size_t>(level.tiles_across) * static_cast<std::size_t>(level.tiles_up);
    }
    total_bytes_ = end;
}

/// Places the errors in a level's tiles, and the end of the tiles behind them.
void GroundLayout::place_errors(Level& level, bool finest) const {
    std::size_t planes = height_bytes * parts_of_node;
    for (std::size_t part = 0; part < parts_of_node; ++part) { level.errors[0][part] = planes++ * level.tile_nodes; }
    for (std::size_t part = 0; part < parts_of_node; ++part) {
        const bool is_needing = part == static_cast<std::size_t>(NodePart::Centre) || !finest;
        level.errors[1][part] = has_both_margins_ && is_needing ? planes++ * level.tile_nodes : level.errors[0][part];
    }
    level.tile_bytes = rounded_up(planes * level.tile_nodes, 2);
}

} // namespace octant::visuals::terrain
