// What a tile is made of, and where it lies: heights, and the errors of tile_builder_errors.cpp.
#include "visuals/terrain/tile_builder.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace octant::visuals::terrain {

namespace {

constexpr int widest_half = 16; ///< In lattice steps.

std::size_t index_of(int column, int row, int columns) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

} // namespace

TileBuilder::TileBuilder(
    const GroundLayout& layout, const StoredHeights& heights, const ErrorEncoder& coder, std::span<std::byte> memory)
    : layout_(layout), heights_(heights), coder_(coder), memory_(memory),
      lattice_errors_((tile_edge_nodes + 2) * (tile_edge_nodes + 2)), unsaturated_codes_(tile_edge_nodes + 1),
      dependent_codes_(tile_edge_nodes + 1), errors_(tile_edge_nodes + 1) {
    for (Codes& codes : codes_) {
        codes.children.resize(children_edge * children_edge);
        codes.souths.resize((tile_edge_nodes + 1) * tile_edge_nodes);
        codes.wests.resize((tile_edge_nodes + 1) * tile_edge_nodes);
        codes.centres.resize(tile_edge_nodes * tile_edge_nodes);
    }
}

std::span<const std::byte> TileBuilder::build(const TileIndex& place) {
    level_ = place.level;
    TileExtent& e = extent_;
    e.at = layout_.level(place.level);
    e.first_column = place.column << e.at.tile_shift;
    e.first_row = place.row << e.at.tile_shift;
    e.columns = std::min(1 << e.at.tile_shift, e.at.columns - e.first_column);
    e.rows = std::min(1 << e.at.tile_shift, e.at.rows - e.first_row);
    e.half = e.at.edge / 2;
    e.stride = std::max(1, e.half / widest_half);
    choose_lattice();
    fetch_children(MorphMargin::Full);
    fetch_children(MorphMargin::None);
    fetch_lattice_errors();
    measure_relief();
    measure_souths();
    measure_wests();
    measure_centres();
    tile_.assign(e.at.tile_bytes, std::byte{0});
    write_heights();
    // Where both rooms share a place, errors with full room are written last.
    write_errors(MorphMargin::None);
    write_errors(MorphMargin::Full);
    write_strips();
    return tile_;
}

/// Sets the lattice of samples to look at: the field itself, or a copy of every stride-th sample.
void TileBuilder::choose_lattice() {
    const TileExtent& e = extent_;
    if (e.stride == 1) {
        lattice_ = heights_.numbers.data();
        pitch_ = heights_.columns;
        lattice_column_ = 0;
        lattice_row_ = 0;
        return;
    }
    lattice_column_ = std::max(0, e.first_column * e.at.edge - e.half);
    lattice_row_ = std::max(0, e.first_row * e.at.edge - e.half);
    const int east = std::min(heights_.columns - 1, (e.first_column + e.columns) * e.at.edge + e.half);
    const int north = std::min(heights_.rows - 1, (e.first_row + e.rows) * e.at.edge + e.half);
    pitch_ = (east - lattice_column_) / e.stride + 1;
    lattice_copy_.clear();
    for (int row = lattice_row_; row <= north; row += e.stride) {
        for (int column = lattice_column_; column <= east; column += e.stride) {
            lattice_copy_.push_back(heights_.number(column, row));
        }
    }
    lattice_ = lattice_copy_.data();
}

/// A row of diamonds on the lattice, given by the sample of the first middle.
DiamondRow TileBuilder::lattice_row(int column, int row, int count) const {
    const std::ptrdiff_t across = (column - lattice_column_) / extent_.stride;
    const std::ptrdiff_t up = (row - lattice_row_) / extent_.stride;
    return {lattice_ + up * pitch_ + across, pitch_, extent_.half / extent_.stride, count};
}

/// Copies the codes of the centres one level finer from finished tiles.
void TileBuilder::fetch_children(MorphMargin morph_margin) {
    if (level_ + 1 == layout_.levels()) { return; }
    const GroundLayout::Level& finer = layout_.level(level_ + 1);
    const int tile_nodes_edge = 1 << finer.tile_shift;
    std::vector<std::uint8_t>& children = codes_with(morph_margin).children;
    std::fill(children.begin(), children.end(), std::uint8_t{0});
    const int west = std::max(0, 2 * extent_.first_column - 1);
    const int east = std::min(finer.columns, 2 * (extent_.first_column + extent_.columns) + 1);
    const int south = std::max(0, 2 * extent_.first_row - 1);
    const int north = std::min(finer.rows, 2 * (extent_.first_row + extent_.rows) + 1);
    for (int row = south; row < north; ++row) {
        for (int column = west; column < east;) {
            const int in_tile = column & (tile_nodes_edge - 1);
            const int count = std::min(tile_nodes_edge - in_tile, east - column);
            const std::size_t tile = index_of(column >> finer.tile_shift, row >> finer.tile_shift, finer.tiles_across);
            const std::size_t node = index_of(in_tile, row & (tile_nodes_edge - 1), tile_nodes_edge);
            const std::byte* const codes = memory_.data() + finer.first_tile + tile * finer.tile_bytes +
                                           finer.errors[static_cast<std::size_t>(morph_margin)][0];
            std::memcpy(&children[index_of(
                            column - 2 * extent_.first_column + 1, row - 2 * extent_.first_row + 1, children_edge)],
                codes + node, static_cast<std::size_t>(count));
            column += count;
        }
    }
}

/// The stored height of a sample, whose place is given in half edges from the field's south-west corner.
std::int16_t TileBuilder::height(int column, int row) const {
    return heights_.stored(heights_.padded_number(column * extent_.half, row * extent_.half));
}

void TileBuilder::write_heights() {
    const TileExtent& e = extent_;
    auto* const tile = reinterpret_cast<std::int16_t*>(tile_.data());
    const auto part = [&](std::size_t which, int from_west, int from_south) {
        for (int row = 0; row < e.rows; ++row) {
            std::int16_t* const out = tile + which * e.at.tile_nodes + index_of(0, row, 1 << e.at.tile_shift);
            const int up = 2 * (e.first_row + row) + from_south;
            const int across = 2 * e.first_column + from_west;
            const int left = heights_.columns - 1 - across * e.half;
            const bool within = left >= 0 && up * e.half < heights_.rows;
            const int copied = within ? std::min(left / e.at.edge + 1, e.columns) : 0;
            for (int column = 0; column < copied; ++column) {
                out[column] = heights_.stored(heights_.number(across * e.half + column * e.at.edge, up * e.half));
            }
            for (int column = copied; column < e.columns; ++column) { out[column] = height(across + 2 * column, up); }
        }
    };
    part(static_cast<std::size_t>(0), 1, 1);
    part(static_cast<std::size_t>(1), 1, 0);
    part(static_cast<std::size_t>(2), 0, 1);
}

void TileBuilder::write_errors(MorphMargin morph_margin) {
    const TileExtent& e = extent_;
    const Codes& own = codes_with(morph_margin);
    const auto part = [&](std::size_t which, const std::vector<std::uint8_t>& codes, int pitch) {
        std::byte* const out = tile_.data() + e.at.errors[static_cast<std::size_t>(morph_margin)][which];
        for (int row = 0; row < e.rows; ++row) {
            std::memcpy(out + index_of(0, row, 1 << e.at.tile_shift), &codes[index_of(0, row, pitch)],
                static_cast<std::size_t>(e.columns));
        }
    };
    part(0, own.centres, e.columns);
    part(1, own.souths, e.columns);
    part(2, own.wests, e.columns + 1);
}

/// Writes the strips beyond the last row and column of nodes, where this tile is beside them.
void TileBuilder::write_strips() {
    const TileExtent& e = extent_;
    if (e.first_row + e.rows == e.at.rows) {
        auto* const out = reinterpret_cast<std::int16_t*>(memory_.data() + e.at.north_heights);
        for (int column = e.first_column; column < e.first_column + e.columns; ++column) {
            out[column] = height(2 * column + 1, 2 * e.at.rows);
        }
        for (const std::size_t morph_margin : {1U, 0U}) {
            std::memcpy(memory_.data() + e.at.north_errors[morph_margin] + e.first_column,
                &codes_[morph_margin].souths[index_of(0, e.rows, e.columns)], static_cast<std::size_t>(e.columns));
        }
    }
    if (e.first_column + e.columns == e.at.columns) {
        auto* const out = reinterpret_cast<std::int16_t*>(memory_.data() + e.at.east_heights);
        for (int row = 0; row < e.rows; ++row) {
            out[e.first_row + row] = height(2 * e.at.columns, 2 * (e.first_row + row) + 1);
            for (const std::size_t morph_margin : {1U, 0U}) {
                memory_[e.at.east_errors[morph_margin] + static_cast<std::size_t>(e.first_row + row)] =
                    std::byte{codes_[morph_margin].wests[index_of(e.columns, row, e.columns + 1)]};
            }
        }
    }
}

} // namespace octant::visuals::terrain
