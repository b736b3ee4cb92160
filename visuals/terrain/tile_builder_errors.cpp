// Saturated errors of a tile: P. Lindstrom, V. Pascucci, "Terrain Simplification Simplified", 2002, section 3 (errors
// saturated along the dependencies of longest-edge bisection).
//
// Each sample gets the maximum of its own error and the stored errors of the samples that need it: middles of edges
// from centres one level finer, centres from middles of their own level. Maxima are taken of the one-byte codes, which
// keep the order.
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
//   (full_margin_px in error_survey.h).
#include "visuals/terrain/tile_builder.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace octant::visuals::terrain {

namespace {

constexpr int lattice_levels = 5; ///< Nodes so far below have an edge of one lattice step.

/// S on rugged ground, for vertices that move beside the eye and for those far off.
constexpr float rugged_near_morph_rate = 1.2F;
constexpr float rugged_far_morph_rate = 4.7F;
/// The least relief of rugged ground, and how many times larger S is on flat ground at most.
constexpr float rugged_m = 1200.0F;
constexpr float max_flatness_factor = 1.8F;
/// The largest error that moves beside the eye, as a share of the ground's relief.
constexpr float near_error = 0.6F / 512.0F;

std::size_t index_of(int column, int row, int columns) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

/// How many times larger S is than on rugged ground.
float flatness_factor(float relief_m) { return std::clamp(rugged_m / relief_m, 1.0F, max_flatness_factor); }

/// Raises a row of codes to others.
void raise(std::span<const std::uint8_t> least, std::uint8_t* codes) {
    for (std::size_t i = 0; i < least.size(); ++i) { codes[i] = std::max(codes[i], least[i]); }
}

} // namespace

float far_morph_rate_on(float relief_m) { return rugged_far_morph_rate * flatness_factor(relief_m); }

/// Finds out what a lattice of more than one sample's step does not see.
void TileBuilder::fetch_lattice_errors() {
    const TileExtent& e = extent_;
    std::fill(lattice_errors_.begin(), lattice_errors_.end(), 0.0F);
    if (e.stride == 1) { return; }
    for (int row = -1; row <= e.rows; ++row) {
        for (int column = -1; column <= e.columns; ++column) {
            const std::uint8_t code = largest_code(level_ + lattice_levels, e.first_column + column, e.first_row + row);
            lattice_errors_[index_of(column + 1, row + 1, tile_edge_nodes + 2)] = coder_.steps_of(code);
        }
    }
}

/// The largest code, without room, of the centres of a finer level in a node of this level; 0 beyond the field.
std::uint8_t TileBuilder::largest_code(int level, int column, int row) const {
    const GroundLayout::Level& finer = layout_.level(level);
    const int across = 1 << (level - level_);
    const int mask = (1 << finer.tile_shift) - 1;
    std::uint8_t largest = 0;
    for (int y = std::max(row, 0) * across; y < std::min((row + 1) * across, finer.rows); ++y) {
        for (int x = std::max(column, 0) * across; x < std::min((column + 1) * across, finer.columns); ++x) {
            const std::size_t tile = index_of(x >> finer.tile_shift, y >> finer.tile_shift, finer.tiles_across);
            const std::byte* const codes = memory_.data() + finer.first_tile + tile * finer.tile_bytes +
                                           finer.errors[static_cast<std::size_t>(MorphMargin::None)][0];
            largest = std::max(largest, static_cast<std::uint8_t>(codes[index_of(x & mask, y & mask, mask + 1)]));
        }
    }
    return largest;
}

/// The same for a node by its place in the tile, which may be one beside it.
float TileBuilder::lattice_error(int column, int row) const {
    return lattice_errors_[index_of(column + 1, row + 1, tile_edge_nodes + 2)];
}

/// Takes the ground's relief from the ranges in memory, and S from that.
void TileBuilder::measure_relief() {
    HeightRange whole;
    std::memcpy(&whole, memory_.data() + layout_.level(0).ranges, sizeof whole);
    const int stored = whole.highest - whole.lowest;
    const float relief = static_cast<float>(stored) / static_cast<float>(heights_.multiplier);
    const float relief_m = relief * static_cast<float>(heights_.number_unit_m);
    near_morph_rate_ = rugged_near_morph_rate * flatness_factor(relief_m);
    far_morph_rate_ = far_morph_rate_on(relief_m);
    inverse_far_morph_rate_ = 1.0F / far_morph_rate_;
    morph_rate_by_error_ = near_morph_rate_ / (near_error * relief);
}

/// The least error of a sample with room to move, given the largest code of those that need it and twice what the
/// ground moves by without it.
inline std::uint8_t TileBuilder::with_margin(std::uint8_t below, int twice) const {
    if (below == 0 || twice == 0) { return below; }
    const float error = coder_.steps_of(below);
    const float move = 0.5F * static_cast<float>(std::abs(twice));
    const float least = error + move * inverse_far_morph_rate_;
    const float fastest_move = std::clamp(morph_rate_by_error_ * least, near_morph_rate_, far_morph_rate_);
    return std::max(below, coder_.code_of(error + move / fastest_move));
}

/// Raises the codes of a row of samples to the least errors with room to move, given the largest codes of those that
/// need them.
void TileBuilder::raise_to_margin(
    const SplitEdgeRow& edges, std::span<const std::uint8_t> below, std::uint8_t* codes) const {
    const int across = std::abs(edges.to_end[0]);
    const int up = edges.to_end[1];
    const int count = static_cast<int>(below.size());
    // So many have both ends within the field.
    const int morph_margin = heights_.columns - 1 - across - edges.column;
    const bool low = edges.row + up < heights_.rows;
    const int inside = low && morph_margin >= 0 ? std::min(count, morph_margin / edges.step + 1) : 0;
    const std::int16_t* middle =
        inside > 0 ? &heights_.numbers[index_of(edges.column, edges.row, heights_.columns)] : nullptr;
    const std::ptrdiff_t climb = std::ptrdiff_t{up} * heights_.columns;
    for (int i = 0; i < inside; ++i) {
        const bool turned = edges.alternate && (i & 1) != 0;
        const std::ptrdiff_t end = climb + (turned ? -edges.to_end[0] : edges.to_end[0]);
        const auto at = static_cast<std::size_t>(i);
        const int twice = 2 * middle[0] - middle[end] - middle[-end];
        codes[at] = std::max(codes[at], with_margin(below[at], twice));
        middle += edges.step;
    }
    const auto number = [this](int column, int row) { return static_cast<int>(heights_.padded_number(column, row)); };
    for (int i = inside; i < count; ++i) {
        const bool turned = edges.alternate && (i & 1) != 0;
        const int aside = turned ? -edges.to_end[0] : edges.to_end[0];
        const int column = edges.column + i * edges.step;
        const auto at = static_cast<std::size_t>(i);
        const int twice = 2 * number(column, edges.row) - number(column + aside, edges.row + up) -
                          number(column - aside, edges.row - up);
        codes[at] = std::max(codes[at], with_margin(below[at], twice));
    }
}

/// Measures the own errors of a row of samples: the middles of nodes, of their south edges or of their west edges.
void TileBuilder::measure(int row, Diamond diamond, std::span<std::uint8_t> codes) {
    const TileExtent& e = extent_;
    const int count = static_cast<int>(codes.size());
    const int from_edge = diamond == Diamond::Upright ? 0 : e.half;
    const int first = e.first_column * e.at.edge + from_edge;
    // From `begin` to `end` the whole diamond lies within the field.
    const int begin = first < e.half ? 1 : 0;
    int end = (heights_.columns - 1 - e.half - first + e.at.edge) / e.at.edge;
    if (row < e.half || row + e.half > heights_.rows - 1) { end = 0; }
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
            const DiamondPosition place{first + i * e.at.edge, row, e.half, e.stride};
            error = padded_error(heights_, place, turned(i));
        }
        codes[static_cast<std::size_t>(i)] = coder_.code_of(error + lattice_error_by(i, row, diamond));
    }
}

/// What the lattice does not see of the diamond of a row of samples, as measure() counts them.
float TileBuilder::lattice_error_by(int index, int row, Diamond diamond) const {
    const int node_row = row / extent_.at.edge - extent_.first_row;
    switch (diamond) {
    case Diamond::Lying:
        return std::max(lattice_error(index, node_row - 1), lattice_error(index, node_row));
    case Diamond::Upright:
        return std::max(lattice_error(index - 1, node_row), lattice_error(index, node_row));
    default:
        return lattice_error(index, node_row);
    }
}

/// Saturates the own errors of a row of middles of edges, given where the first of the four centres around each lie
/// among the children.
void TileBuilder::saturate_middles(
    const SplitEdgeRow& edges, std::size_t children, const RowOfCodes& own, const MarginRows& out) {
    for (const MorphMargin morph_margin : {MorphMargin::Full, MorphMargin::None}) {
        std::copy(own.begin(), own.end(), out[static_cast<std::size_t>(morph_margin)]);
    }
    if (level_ + 1 == layout_.levels()) { return; }
    const std::span below = std::span(dependent_codes_).first(own.size());
    for (const MorphMargin morph_margin : {MorphMargin::Full, MorphMargin::None}) {
        const std::uint8_t* const south = &codes_with(morph_margin).children[children];
        const std::uint8_t* const north = south + children_edge;
        for (std::size_t i = 0; i < below.size(); ++i) {
            below[i] = std::max(std::max(south[2 * i], south[2 * i + 1]), std::max(north[2 * i], north[2 * i + 1]));
        }
        std::uint8_t* const codes = out[static_cast<std::size_t>(morph_margin)];
        if (morph_margin == MorphMargin::Full) {
            raise_to_margin(edges, below, codes);
        } else {
            raise(below, codes);
        }
    }
}

/// The stored errors of the middles of south edges.
void TileBuilder::measure_souths() {
    const TileExtent& e = extent_;
    const std::span own = std::span(unsaturated_codes_).first(static_cast<std::size_t>(e.columns));
    const int column = e.first_column * e.at.edge + e.half;
    for (int y = 0; y <= e.rows; ++y) {
        const int row = (e.first_row + y) * e.at.edge;
        measure(row, Diamond::Lying, own);
        const std::size_t to = index_of(0, y, e.columns);
        saturate_middles({column, row, e.at.edge, {e.half, 0}, false}, index_of(1, 2 * y, children_edge), own,
            {&codes_with(MorphMargin::Full).souths[to], &codes_with(MorphMargin::None).souths[to]});
    }
}

/// The stored errors of the middles of west edges.
void TileBuilder::measure_wests() {
    const TileExtent& e = extent_;
    const std::span own = std::span(unsaturated_codes_).first(static_cast<std::size_t>(e.columns) + 1);
    const int column = e.first_column * e.at.edge;
    for (int y = 0; y < e.rows; ++y) {
        const int row = (e.first_row + y) * e.at.edge + e.half;
        measure(row, Diamond::Upright, own);
        const std::size_t to = index_of(0, y, e.columns + 1);
        saturate_middles({column, row, e.at.edge, {0, e.half}, false}, index_of(0, 2 * y + 1, children_edge), own,
            {&codes_with(MorphMargin::Full).wests[to], &codes_with(MorphMargin::None).wests[to]});
    }
}

/// The stored errors of the centres, which come last because they need those of the edges.
void TileBuilder::measure_centres() {
    const TileExtent& e = extent_;
    const std::span own = std::span(unsaturated_codes_).first(static_cast<std::size_t>(e.columns));
    const std::span below = std::span(dependent_codes_).first(own.size());
    for (int y = 0; y < e.rows; ++y) {
        const bool falling = ((e.first_row + y + e.first_column) & 1) != 0;
        const SplitEdgeRow edges{e.first_column * e.at.edge + e.half, (e.first_row + y) * e.at.edge + e.half, e.at.edge,
            {falling ? -e.half : e.half, e.half}, true};
        measure(edges.row, falling ? Diamond::Falling : Diamond::Rising, own);
        for (const MorphMargin morph_margin : {MorphMargin::Full, MorphMargin::None}) {
            Codes& codes = codes_with(morph_margin);
            fetch_middles(codes, y, below);
            std::uint8_t* const out = &codes.centres[index_of(0, y, e.columns)];
            std::copy(own.begin(), own.end(), out);
            if (morph_margin == MorphMargin::Full) {
                raise_to_margin(edges, below, out);
            } else {
                raise(below, out);
            }
        }
    }
}

/// The largest codes of the middles of the edges of a row of nodes.
void TileBuilder::fetch_middles(const Codes& codes, int row, std::span<std::uint8_t> largest) const {
    const std::uint8_t* const south = &codes.souths[index_of(0, row, extent_.columns)];
    const std::uint8_t* const north = south + extent_.columns;
    const std::uint8_t* const west = &codes.wests[index_of(0, row, extent_.columns + 1)];
    for (std::size_t i = 0; i < largest.size(); ++i) {
        largest[i] = std::max(std::max(south[i], north[i]), std::max(west[i], west[i + 1]));
    }
}

} // namespace octant::visuals::terrain
