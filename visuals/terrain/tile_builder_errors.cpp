// Saturated errors of a tile: P. Lindstrom, V. Pascucci, "Terrain Simplification Simplified", 2002,
// section 3 (errors saturated along the dependencies of longest-edge bisection).
//
// Each sample gets the maximum of its own error and the stored errors of the samples that need it:
// middles of edges from centres one level finer, centres from middles of their own level. Maxima
// are taken of the one-byte codes, which keep the order.
//
// Deviations:
// - The own error is the true largest deviation inside a sample's diamond (17 % fewer triangles at
//   equal error than with that of the middle alone). A diamond's legs are left to the smaller
//   diamonds on them, which saturation includes.
// - Diamonds with a half edge above 16 samples look at every (half / 16)-th sample in each
//   direction. To their deviation is added the largest error in the mesh of the samples looked at,
//   that of the nodes five levels below: no sample between can lie farther off.
// - Where leaving a sample out moves the ground by d, its error is at least that of the samples
//   that need it and d / S more, so that it has the time to move into its place before they appear
//   (error_mesher.cpp). S is how far a vertex may move, in wanted errors, while its distance
//   shrinks by a small share of itself, divided by that share. A larger error moves at a larger
//   distance, of which the eye's way is a smaller share: S grows with the least error that the
//   sample can get, up to where the wanted error's own changes count, which are alike at all
//   distances. With the same triangles the wanted error grows with the ground's relief: S shrinks.
// - Errors are stored with this room and without any. Where the wanted error E stays as it is from
//   frame to frame, vertices may move farther in wanted errors the smaller E is, up to S E0 pixels:
//   d E / (S E0) is enough, and errors between the two stored ones are nested as they are
//   (full_room_px in error_survey.h).
#include "visuals/terrain/ground_tiles.h"
#include "visuals/terrain/tile_builder.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace octant::visuals::terrain {

namespace {

constexpr int levels_unseen = 5; ///< Nodes so far below have an edge of one lattice step.

/// S on rugged ground, for vertices that move beside the eye and for those far off.
constexpr float near_move = 1.2F;
constexpr float far_move = 4.7F;
/// The least relief of rugged ground, and how many times larger S is on flat ground at most.
constexpr float rugged_m = 1200.0F;
constexpr float most_ease = 1.8F;
/// The largest error that moves beside the eye, as a share of the ground's relief.
constexpr float near_error = 0.6F / 512.0F;

std::size_t index_of(int column, int row, int columns) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
}

} // namespace

/// Finds out what a lattice of more than one sample's step does not see.
void TileBuilder::fetch_unseen() {
    const Extent& e = extent_;
    std::fill(unseen_.begin(), unseen_.end(), 0.0F);
    if (e.stride == 1) {
        return;
    }
    for (int row = -1; row <= e.rows; ++row) {
        for (int column = -1; column <= e.columns; ++column) {
            const std::uint8_t code =
                largest_code(level_ + levels_unseen, e.first_column + column, e.first_row + row);
            unseen_[index_of(column + 1, row + 1, most + 2)] =
                GroundTiles::error_m_of(code) / static_cast<float>(heights_.number_unit_m);
        }
    }
}

/// The largest code, without room, of the centres of a finer level in a node of this level; 0
/// beyond the field.
std::uint8_t TileBuilder::largest_code(int level, int column, int row) const {
    const GroundLayout::Level& finer = layout_.level(level);
    const int across = 1 << (level - level_);
    const int mask = (1 << finer.tile_shift) - 1;
    std::uint8_t largest = 0;
    for (int y = std::max(row, 0) * across; y < std::min((row + 1) * across, finer.rows); ++y) {
        for (int x = std::max(column, 0) * across;
             x < std::min((column + 1) * across, finer.columns);
             ++x) {
            const std::size_t tile =
                index_of(x >> finer.tile_shift, y >> finer.tile_shift, finer.tiles_across);
            const std::byte* const codes = memory_.data() + finer.first_tile +
                                           tile * finer.tile_bytes +
                                           finer.errors[static_cast<std::size_t>(Room::None)][0];
            largest = std::max(
                largest, static_cast<std::uint8_t>(codes[index_of(x & mask, y & mask, mask + 1)]));
        }
    }
    return largest;
}

/// The same for a node by its place in the tile, which may be one beside it.
float TileBuilder::unseen(int column, int row) const {
    return unseen_[index_of(column + 1, row + 1, most + 2)];
}

/// Takes the ground's relief from the ranges in memory, and S from that.
void TileBuilder::measure_relief() {
    HeightRange whole;
    std::memcpy(&whole, memory_.data() + layout_.level(0).ranges, sizeof whole);
    const int stored = whole.highest - whole.lowest;
    const float relief = static_cast<float>(stored) / static_cast<float>(heights_.multiplier);
    const float relief_m = relief * static_cast<float>(heights_.number_unit_m);
    const float ease = std::clamp(rugged_m / relief_m, 1.0F, most_ease);
    near_error_ = near_error * relief;
    near_move_ = near_move * ease;
    far_move_ = far_move * ease;
}

/// The least error of a sample with room to move, given the largest code of those that need it.
std::uint8_t TileBuilder::with_room(std::uint8_t below, const Halved& edge) const {
    if (below == 0) {
        return 0;
    }
    const auto number = [this](const std::array<int, 2>& at) {
        return static_cast<int>(heights_.number(
            std::min(at[0], heights_.columns - 1), std::min(at[1], heights_.rows - 1)));
    };
    const int twice = 2 * number(edge.middle) - number(edge.end_a) - number(edge.end_b);
    if (twice == 0) {
        return below;
    }
    const float error = GroundTiles::error_m_of(below) / static_cast<float>(heights_.number_unit_m);
    const float move = 0.5F * static_cast<float>(std::abs(twice));
    const float least = error + move / far_move_;
    const float fastest_move =
        std::clamp(near_move_ * (least / near_error_), near_move_, far_move_);
    return std::max(below, coder_.code_of(error + move / fastest_move));
}

/// Measures the own errors of a row of samples: the middles of nodes, of their south edges or of
/// their west edges.
void TileBuilder::measure(int row, Diamond diamond, std::span<std::uint8_t> codes) {
    const Extent& e = extent_;
    const int count = static_cast<int>(codes.size());
    const int from_edge = diamond == Diamond::Upright ? 0 : e.half;
    const int first = e.first_column * e.at.edge + from_edge;
    // From `begin` to `end` the whole diamond lies within the field.
    const int begin = first < e.half ? 1 : 0;
    int end = (heights_.columns - 1 - e.half - first + e.at.edge) / e.at.edge;
    if (row < e.half || row + e.half > heights_.rows - 1) {
        end = 0;
    }
    end = std::clamp(end, begin, count);
    const bool falling = diamond == Diamond::Falling;
    const auto turned = [&](int i) {
        const bool node = diamond == Diamond::Rising || falling;
        return node && (i & 1) != 0 ? (falling ? Diamond::Rising : Diamond::Falling) : diamond;
    };
    if (end > begin) {
        const DiamondRow inside = lattice_row(first + begin * e.at.edge, row, end - begin);
        float* const errors = &errors_[static_cast<std::size_t>(begin)];
        if (diamond == Diamond::Lying || diamond == Diamond::Upright) {
            diamond_errors(inside, diamond, errors);
        } else {
            node_errors(inside, diamond, errors);
        }
    }
    for (int i = 0; i < count; ++i) {
        float& error = errors_[static_cast<std::size_t>(i)];
        if (i < begin || i >= end) {
            const DiamondPlace place{first + i * e.at.edge, row, e.half, e.stride};
            error = clamped_error(heights_, place, turned(i));
        }
        codes[static_cast<std::size_t>(i)] = coder_.code_of(error + unseen_by(i, row, diamond));
    }
}

/// What the lattice does not see of the diamond of a row of samples, as measure() counts them.
float TileBuilder::unseen_by(int index, int row, Diamond diamond) const {
    const int node_row = row / extent_.at.edge - extent_.first_row;
    switch (diamond) {
    case Diamond::Lying:
        return std::max(unseen(index, node_row - 1), unseen(index, node_row));
    case Diamond::Upright:
        return std::max(unseen(index - 1, node_row), unseen(index, node_row));
    default:
        return unseen(index, node_row);
    }
}

/// The stored errors of the middles of south edges.
void TileBuilder::measure_souths() {
    const Extent& e = extent_;
    Codes& full = codes_with(Room::Full);
    Codes& none = codes_with(Room::None);
    const std::span own = std::span(own_codes_).first(static_cast<std::size_t>(e.columns));
    for (int row = 0; row <= e.rows; ++row) {
        measure((e.first_row + row) * e.at.edge, Diamond::Lying, own);
        for (int column = 0; column < e.columns; ++column) {
            const std::uint8_t code = own[static_cast<std::size_t>(column)];
            const std::size_t to = index_of(column, row, e.columns);
            const int west = (e.first_column + column) * e.at.edge;
            const int at = (e.first_row + row) * e.at.edge;
            const Halved edge{{west + e.half, at}, {west, at}, {west + e.at.edge, at}};
            const std::uint8_t below = children(full, 2 * column + 1, 2 * row);
            full.souths[to] = std::max(code, with_room(below, edge));
            none.souths[to] = std::max(code, children(none, 2 * column + 1, 2 * row));
        }
    }
}

/// The stored errors of the middles of west edges.
void TileBuilder::measure_wests() {
    const Extent& e = extent_;
    Codes& full = codes_with(Room::Full);
    Codes& none = codes_with(Room::None);
    const std::span own = std::span(own_codes_).first(static_cast<std::size_t>(e.columns) + 1);
    for (int row = 0; row < e.rows; ++row) {
        measure((e.first_row + row) * e.at.edge + e.half, Diamond::Upright, own);
        for (int column = 0; column <= e.columns; ++column) {
            const std::uint8_t code = own[static_cast<std::size_t>(column)];
            const std::size_t to = index_of(column, row, e.columns + 1);
            const int at = (e.first_column + column) * e.at.edge;
            const int south = (e.first_row + row) * e.at.edge;
            const Halved edge{{at, south + e.half}, {at, south}, {at, south + e.at.edge}};
            const std::uint8_t below = children(full, 2 * column, 2 * row + 1);
            full.wests[to] = std::max(code, with_room(below, edge));
            none.wests[to] = std::max(code, children(none, 2 * column, 2 * row + 1));
        }
    }
}

/// The stored errors of the centres, which come last because they need those of the edges.
void TileBuilder::measure_centres() {
    const Extent& e = extent_;
    Codes& full = codes_with(Room::Full);
    Codes& none = codes_with(Room::None);
    const std::span own = std::span(own_codes_).first(static_cast<std::size_t>(e.columns));
    for (int row = 0; row < e.rows; ++row) {
        const bool falling = ((e.first_row + row + e.first_column) & 1) != 0;
        measure(
            (e.first_row + row) * e.at.edge + e.half,
            falling ? Diamond::Falling : Diamond::Rising,
            own);
        for (int column = 0; column < e.columns; ++column) {
            const std::uint8_t code = own[static_cast<std::size_t>(column)];
            const std::size_t to = index_of(column, row, e.columns);
            const Halved edge = diagonal_of(column, row, falling != ((column & 1) != 0));
            full.centres[to] = std::max(code, with_room(middles(full, column, row), edge));
            none.centres[to] = std::max(code, middles(none, column, row));
        }
    }
}

/// The largest code of the middles of a node's edges.
std::uint8_t TileBuilder::middles(const Codes& codes, int column, int row) const {
    const auto columns = static_cast<std::size_t>(extent_.columns);
    const std::size_t south = index_of(column, row, extent_.columns);
    const std::size_t west = index_of(column, row, extent_.columns + 1);
    return std::max(
        {codes.souths[south],
         codes.souths[south + columns],
         codes.wests[west],
         codes.wests[west + 1]});
}

/// The edge that a node's centre halves.
TileBuilder::Halved TileBuilder::diagonal_of(int column, int row, bool falling) const {
    const Extent& e = extent_;
    const int west = (e.first_column + column) * e.at.edge;
    const int south = (e.first_row + row) * e.at.edge;
    const int north = south + e.at.edge;
    const int from = falling ? west + e.at.edge : west;
    const int to = falling ? west : west + e.at.edge;
    return {{west + e.half, south + e.half}, {from, south}, {to, north}};
}

} // namespace octant::visuals::terrain
