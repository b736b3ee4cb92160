// Access to a ground's numbers by node and by sample.

#include "visuals/terrain/bisection_tiles.h"

#include "models/heights/height_field.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <utility>

namespace octant::visuals::terrain {

// Computes the offsets of bisection_tiles.h. Tiles keep what a mesh looks at together in few pages, so that a mapped
// file is read in large pieces.

namespace {

constexpr std::size_t parts_of_node = 3;
constexpr std::size_t height_bytes = 2;

std::size_t rounded_up(std::size_t bytes, std::size_t multiple) { return (bytes + multiple - 1) / multiple * multiple; }

int rounded_up_quotient(int dividend, int divisor) { return (dividend + divisor - 1) / divisor; }

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
        for (std::size_t morph_margin = 0; morph_margin < 2; ++morph_margin) {
            std::fill(level.north_errors.begin() + morph_margin, level.north_errors.end(), end);
            std::fill(level.east_errors.begin() + morph_margin, level.east_errors.end(), end + across);
            end += across + up;
        }
        end = rounded_up(end, 2);
    }
    end = rounded_up(end, page_bytes);
    for (Level& level : levels_) {
        level.first_tile = end;
        end += level.tile_bytes * level.tile_count();
    }
    total_bytes_ = end;
}

/// Places the errors in a level's tiles, and the end of the tiles behind them.
void GroundLayout::place_errors(Level& level, bool finest) {
    std::size_t planes = height_bytes * parts_of_node;
    for (std::size_t part = 0; part < parts_of_node; ++part) { level.errors[0][part] = planes++ * level.tile_nodes; }
    for (std::size_t part = 0; part < parts_of_node; ++part) {
        const bool is_needing = part == static_cast<std::size_t>(NodePart::Centre) || !finest;
        level.errors[1][part] = is_needing ? planes++ * level.tile_nodes : level.errors[0][part];
    }
    level.tile_bytes = rounded_up(planes * level.tile_nodes, 2);
}

// Tables of error codes: geometric series, so that one byte covers centimetres to kilometres. An error is rounded up to
// its code, by half a step in the mean, and that costs triangles: steps are narrow where meshes have most of their
// samples.

ErrorCodes::ErrorCodes(double height_unit_m) {
    // Numbers, not roots: a file means the same wherever it is read.
    constexpr double wide = 1.148698355;   // 20 steps to 16 times
    constexpr double narrow = 1.036271381; // 214 steps to 2048 times
    constexpr std::size_t first_narrow = 21;
    constexpr std::size_t end_narrow = 235;
    double units = 0.25;
    for (std::size_t code = 1; code < metres_.size(); ++code) {
        metres_[code] = static_cast<float>(units * height_unit_m);
        units *= code >= first_narrow && code < end_narrow ? narrow : wide;
    }
}

std::uint8_t ErrorCodes::code_of(float error_m) const {
    const auto at = std::lower_bound(metres_.begin(), metres_.end(), error_m);
    return static_cast<std::uint8_t>(std::min<std::ptrdiff_t>(at - metres_.begin(), 255));
}

GroundTiles::GroundTiles(const GroundShape& shape, GroundMetadata metadata, std::span<const std::byte> memory,
    std::shared_ptr<const void> owner, std::shared_ptr<const TileValidator> validator)
    : shape_(shape), metadata_(std::move(metadata)), layout_(shape), codes_(shape.height_unit_m), memory_(memory),
      owner_(std::move(owner)),
      validator_(validator ? std::move(validator) : std::make_shared<const TileValidator>(layout_)),
      base_m_(shape.height_base_m), unit_m_(shape.height_unit_m) {
    assert(memory.size() == layout_.total_bytes());
}

float GroundTiles::height_m(int column, int row) const {
    assert(column >= 0 && row >= 0 && column < columns() && row < rows());
    const auto steps = static_cast<unsigned>(column | row);
    const int root_edge = layout_.level(0).edge;
    if (steps % static_cast<unsigned>(root_edge) == 0) {
        return corner_m((column != 0 ? 1U : 0U) + (row != 0 ? 2U : 0U));
    }
    const int zeros = std::countr_zero(steps);
    const int level = levels() - 1 - zeros;
    const int half = 1 << zeros;
    const NodePart part = (column & half) == 0 ? NodePart::West
                          : (row & half) == 0  ? NodePart::South
                                               : NodePart::Centre;
    return height_m(level, part, column >> (zeros + 1), row >> (zeros + 1));
}

void GroundTiles::copy_row(int row, std::span<float> heights_m) const {
    assert(row >= 0 && row < rows() && heights_m.size() == static_cast<std::size_t>(columns()));
    // A level has the odd samples of the rows that are left to it, and all samples of its odd rows.
    for (int level = levels() - 1; level >= 0; --level, row /= 2) {
        copy_parts(level, row % 2 == 0 ? NodePart::South : NodePart::Centre, row / 2, heights_m);
        if (row % 2 != 0) {
            copy_parts(level, NodePart::West, row / 2, heights_m);
            return;
        }
    }
    const auto east = static_cast<std::size_t>(layout_.level(0).edge);
    heights_m[0] = corner_m(row != 0 ? 2U : 0U);
    if (east < heights_m.size()) { heights_m[east] = corner_m(row != 0 ? 3U : 1U); }
}

/// Copies the heights of one part of all nodes of a level's row, which may be the one beyond the last, to the places of
/// their samples.
void GroundTiles::copy_parts(int level, NodePart part, int row, std::span<float> heights_m) const {
    const GroundLayout::Level& at = layout_.level(level);
    const int edge = at.edge;
    const int first = part == NodePart::West ? 0 : edge / 2;
    const int nodes = (columns() - first + edge - 1) / edge;
    for (int column = 0; column < nodes;) {
        float* to = &heights_m[static_cast<std::size_t>(first + column * edge)];
        if (row == at.rows || column == at.columns) {
            *to = height_m(level, part, column, row);
            ++column;
            continue;
        }
        const std::int16_t* const stored =
            heights_at(valid_tile(level, column, row) + at.height_offset(part, at.node_in_tile(column, row)));
        const int end = std::min({nodes, at.columns, ((column >> at.tile_shift) + 1) << at.tile_shift});
        for (int k = 0; column < end; ++k, ++column, to += edge) { *to = height_of(stored[k]); }
    }
}

glm::dvec2 GroundTiles::half_extent_m() const {
    return {0.5 * (columns() - 1) * spacing_m(), 0.5 * (rows() - 1) * spacing_m()};
}

std::optional<double> GroundTiles::height_at(double x_m, double y_m) const {
    return models::heights::bilinear_height_m(*this, x_m, y_m);
}

} // namespace octant::visuals::terrain
