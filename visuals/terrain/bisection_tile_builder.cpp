// Builds the tiles of a ground: heights, then saturated errors. First the errors of single diamonds, then the tile,
// then the saturation.
#include "visuals/terrain/bisection_tile_builder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>

#define OCTANT_INLINE __attribute__((always_inline)) inline

namespace octant::visuals::terrain {

// Errors of longest-edge bisection: P. Lindstrom, V. Pascucci, "Visualization of Large Terrains Made Easy", 2001,
// section 2 (bisection and diamonds).
//
// The heights of both triangles of a diamond form a single function that is linear but for one absolute value (of x, of
// y or of x - y), so that rows need no case distinctions and several samples are computed at once. All sums stay below
// 24 bits, so floats are exact here and the order of operations does not matter.
//
// Deviation: the error of a diamond is the true largest deviation of all samples inside, not that of its middle alone.

namespace {

/// Vectors of `width` numbers.
template <int width>
struct Lanes {
    using Floats __attribute__((vector_size(4 * width))) = float;
    using Ints __attribute__((vector_size(4 * width))) = int;
    using Shorts __attribute__((vector_size(2 * width))) = short;
};

/// For d from 0 on the value |d - 2 half|, and for each row which columns lie in a diamond on its corner.
template <int half>
struct DistanceTables {
    static constexpr auto edge = static_cast<std::size_t>(2 * half);
    std::array<float, 2 * edge + 1> distance{};
    std::array<std::array<float, edge>, edge / 2> inside{};

    constexpr DistanceTables() {
        for (std::size_t d = 0; d < distance.size(); ++d) {
            distance[d] = static_cast<float>(d < edge ? edge - d : d - edge);
        }
        for (std::size_t row = 0; row < inside.size(); ++row) {
            for (std::size_t column = 0; column < edge; ++column) {
                inside[row][column] = column >= row && column <= edge - row ? 1.0F : 0.0F;
            }
        }
    }
};

template <int half>
constexpr DistanceTables<half> distance_tables{};

/// The height over one row of samples: start + slope * x + bend * |x - ...|, where the absolute value comes from a
/// table.
struct RowPlane {
    float start;
    float slope;
    float bend;
    const float* distance;
    const float* inside; ///< Null means that the whole row counts.
};

/// Raises `largest` to the deviations of one row of samples from a plane, lane by lane.
template <int half, int width>
OCTANT_INLINE void raise_to_row_error(
    const std::int16_t* numbers, const RowPlane& plane, typename Lanes<width>::Floats& largest) {
    using L = Lanes<width>;
    for (int x = 0; x < 2 * half; x += width) {
        typename L::Shorts whole;
        typename L::Floats distance;
        typename L::Floats place;
        std::memcpy(&whole, numbers + x, sizeof whole);
        std::memcpy(&distance, plane.distance + x, sizeof distance);
        for (int lane = 0; lane < width; ++lane) { place[lane] = static_cast<float>(x + lane); }
        const auto height =
            __builtin_convertvector(__builtin_convertvector(whole, typename L::Ints), typename L::Floats);
        auto error = height - (plane.start + plane.slope * place + plane.bend * distance);
        error = error < 0.0F ? -error : error;
        if (plane.inside != nullptr) {
            typename L::Floats inside;
            std::memcpy(&inside, plane.inside + x, sizeof inside);
            error *= inside;
        }
        largest = largest < error ? error : largest;
    }
}

template <int width>
OCTANT_INLINE float largest_of(const typename Lanes<width>::Floats& values) {
    float largest = values[0];
    for (int lane = 1; lane < width; ++lane) { largest = std::max(largest, values[lane]); }
    return largest;
}

/// The error inside a node whose south-west corner is `corner`.
template <int half, int width>
OCTANT_INLINE float error_of_node(const std::int16_t* corner, std::ptrdiff_t pitch, bool rising) {
    constexpr int edge = 2 * half;
    constexpr float per_sample = 0.5F / edge;
    const float south_west = corner[0];
    const float south_east = corner[edge];
    const float north_west = corner[edge * pitch];
    const float north_east = corner[edge * pitch + edge];
    const float east = ((south_east - south_west) + (north_east - north_west)) * per_sample;
    const float north = ((north_east - south_east) + (north_west - south_west)) * per_sample;
    const float bend = ((south_east - south_west) - (north_east - north_west)) * per_sample;
    const float start = rising ? south_west : south_east - east * edge;
    typename Lanes<width>::Floats largest = {};
    for (int y = 1; y < edge; ++y) {
        const float* const distance = distance_tables<half>.distance.data() + (rising ? edge - y : y);
        raise_to_row_error<half, width>(corner + y * pitch,
            {start + north * static_cast<float>(y), east, rising ? bend : -bend, distance, nullptr}, largest);
    }
    return largest_of<width>(largest);
}

/// The error inside a diamond on its corner.
template <int half, int width>
OCTANT_INLINE float error_of_diamond(const std::int16_t* middle, std::ptrdiff_t pitch, bool upright) {
    constexpr float per_sample = 0.5F / half;
    const float west = middle[-half];
    const float east = middle[half];
    const float south = middle[-half * pitch];
    const float north = middle[half * pitch];
    const float level = 0.5F * (upright ? south + north : west + east);
    const float slope = (east - west) * per_sample;
    const float climb = (north - south) * per_sample;
    const float bend_x = upright ? (east + west - 2.0F * level) * per_sample : 0.0F;
    const float bend_y = upright ? 0.0F : (north + south - 2.0F * level) * per_sample;
    typename Lanes<width>::Floats largest = {};
    for (int y = 1 - half; y < half; ++y) {
        const auto away = static_cast<std::size_t>(std::abs(y));
        const float start = level - slope * half + climb * static_cast<float>(y) + bend_y * static_cast<float>(away);
        raise_to_row_error<half, width>(middle - half + y * pitch,
            {start, slope, bend_x, distance_tables<half>.distance.data() + half,
                distance_tables<half>.inside[away].data()},
            largest);
    }
    return largest_of<width>(largest);
}

/// The errors of a row of diamonds of one size.
template <int half, int widest>
OCTANT_INLINE void errors_of_row(const DiamondRow& row, Diamond first, bool alternate, float* errors) {
    constexpr int width = std::min(widest, 2 * half);
    const std::ptrdiff_t to_corner = half * row.pitch + half;
    Diamond diamond = first;
    for (int i = 0; i < row.count; ++i) {
        const std::int16_t* const middle = row.first_middle + 2 * half * i;
        const bool node = diamond == Diamond::Rising || diamond == Diamond::Falling;
        errors[i] = node ? error_of_node<half, width>(middle - to_corner, row.pitch, diamond == Diamond::Rising)
                         : error_of_diamond<half, width>(middle, row.pitch, diamond == Diamond::Upright);
        if (alternate) { diamond = diamond == Diamond::Rising ? Diamond::Falling : Diamond::Rising; }
    }
}

/// The errors of diamonds with half 1, inside which there is only the middle.
OCTANT_INLINE void errors_of_middles(const DiamondRow& row, Diamond first, bool alternate, float* errors) {
    const std::array<std::ptrdiff_t, 4> ends = {row.pitch + 1, row.pitch - 1, 1, row.pitch};
    const std::ptrdiff_t even = ends[static_cast<std::size_t>(first)];
    const std::ptrdiff_t odd = alternate ? ends[static_cast<std::size_t>(first) ^ std::size_t{1}] : even;
    for (int i = 0; i < row.count; ++i) {
        const std::int16_t* const middle = row.first_middle + 2 * i;
        const std::ptrdiff_t end = (i & 1) == 0 ? even : odd;
        errors[i] = 0.5F * static_cast<float>(std::abs(2 * middle[0] - middle[-end] - middle[end]));
    }
}

template <int widest>
OCTANT_INLINE void errors_of(const DiamondRow& row, Diamond first, bool alternate, float* errors) {
    switch (row.half) {
    case 1:
        return errors_of_middles(row, first, alternate, errors);
    case 2:
        return errors_of_row<2, widest>(row, first, alternate, errors);
    case 4:
        return errors_of_row<4, widest>(row, first, alternate, errors);
    case 8:
        return errors_of_row<8, widest>(row, first, alternate, errors);
    default:
        assert(row.half == 16);
        return errors_of_row<16, widest>(row, first, alternate, errors);
    }
}

using Kernel = void (*)(const DiamondRow&, Diamond, bool, float*);

void errors_width_4(const DiamondRow& row, Diamond first, bool alternate, float* errors) {
    errors_of<4>(row, first, alternate, errors);
}

#ifdef __x86_64__
__attribute__((target("avx2"))) void errors_width_8(
    const DiamondRow& row, Diamond first, bool alternate, float* errors) {
    errors_of<8>(row, first, alternate, errors);
}

/// The widest kernel that this processor can run.
Kernel best_kernel() { return __builtin_cpu_supports("avx2") != 0 ? errors_width_8 : errors_width_4; }
#else
Kernel best_kernel() { return errors_width_4; }
#endif

void run_kernel(const DiamondRow& row, Diamond first, bool alternate, float* errors) {
    static const Kernel kernel = best_kernel();
    kernel(row, first, alternate, errors);
}

/// A corner of a triangle in samples, with its height.
struct TriangleVertex {
    std::int64_t x;
    std::int64_t y;
    double height;
};

std::int64_t signed_area2(const TriangleVertex& a, const TriangleVertex& b, std::int64_t x, std::int64_t y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/// The height of a triangle's plane.
double plane_at(const std::array<TriangleVertex, 3>& at, std::int64_t x, std::int64_t y) {
    const std::int64_t area = signed_area2(at[0], at[1], at[2].x, at[2].y);
    const std::int64_t a = signed_area2(at[1], at[2], x, y);
    const std::int64_t b = signed_area2(at[2], at[0], x, y);
    return (static_cast<double>(a) * at[0].height + static_cast<double>(b) * at[1].height +
               static_cast<double>(area - a - b) * at[2].height) /
           static_cast<double>(area);
}

/// The largest deviation of the lattice's samples in one triangle, edges included, as far as the field or a lattice
/// cell with a part of it reaches.
double error_of_triangle(const StoredHeights& heights, std::array<TriangleVertex, 3> at, int stride) {
    std::int64_t area = signed_area2(at[0], at[1], at[2].x, at[2].y);
    if (area < 0) {
        std::swap(at[1], at[2]);
        area = -area;
    }
    const auto [west, east] = std::minmax({at[0].x, at[1].x, at[2].x});
    const auto [south, north] = std::minmax({at[0].y, at[1].y, at[2].y});
    const auto on_lattice = [stride](std::int64_t from) { return (from + stride - 1) / stride * stride; };
    // No part of the field lies beyond these lines of the lattice.
    const std::int64_t last_x = std::min(east, on_lattice(heights.columns - 1));
    const std::int64_t last_y = std::min(north, on_lattice(heights.rows - 1));
    double largest = 0.0;
    for (std::int64_t y = on_lattice(south); y <= last_y; y += stride) {
        for (std::int64_t x = on_lattice(west); x <= last_x; x += stride) {
            const std::int64_t a = signed_area2(at[1], at[2], x, y);
            const std::int64_t b = signed_area2(at[2], at[0], x, y);
            const std::int64_t c = area - a - b;
            if (a < 0 || b < 0 || c < 0) { continue; }
            const double height = heights.padded_number(static_cast<int>(x), static_cast<int>(y));
            largest = std::max(largest, std::abs(height - plane_at(at, x, y)));
        }
    }
    return largest;
}

/// For each diamond of a row, the largest vertical distance of the samples inside its two triangles and on the
/// hypotenuse from the planes through the triangles' corners, in units of the numbers. The legs are left out, because
/// they are the hypotenuses of diamonds half as wide. Exact.
void diamond_errors(const DiamondRow& row, Diamond diamond, float* errors) { run_kernel(row, diamond, false, errors); }

/// The errors, as of diamond_errors, of a row of nodes whose diagonals alternate, starting with `first` (Rising or
/// Falling).
void node_errors(const DiamondRow& row, Diamond first, float* errors) {
    assert(first == Diamond::Rising || first == Diamond::Falling);
    run_kernel(row, first, true, errors);
}

/// The middle of a diamond anywhere in a field, in samples. Only samples `stride` apart are looked at.
struct DiamondPosition {
    int column = 0;
    int row = 0;
    int half = 1;
    int stride = 1;
};

/// The error of a single diamond, as of diamond_errors, anywhere in the padded square (StoredHeights::padded_number),
/// legs included. Samples beyond the field do not count, except the next ones `stride` apart. Triangles beyond the
/// field's south and west sides do not count.
float padded_error(const StoredHeights& heights, const DiamondPosition& place, Diamond diamond) {
    using Step = std::array<int, 2>;
    // For each kind of diamond the directions from the middle to both ends of the hypotenuse and then to both apexes.
    static constexpr std::array<std::array<Step, 4>, 4> steps = {{
        {{{-1, -1}, {1, 1}, {1, -1}, {-1, 1}}},
        {{{-1, 1}, {1, -1}, {-1, -1}, {1, 1}}},
        {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}},
        {{{0, -1}, {0, 1}, {-1, 0}, {1, 0}}},
    }};
    const auto corner = [&](std::size_t index) {
        const Step& step = steps[static_cast<std::size_t>(diamond)][index];
        const int x = place.column + step[0] * place.half;
        const int y = place.row + step[1] * place.half;
        return TriangleVertex{x, y, x < 0 || y < 0 ? 0.0 : heights.padded_number(x, y)};
    };
    double largest = 0.0;
    for (const std::size_t apex : {std::size_t{2}, std::size_t{3}}) {
        const std::array<TriangleVertex, 3> triangle = {corner(0), corner(1), corner(apex)};
        if (triangle[2].x >= 0 && triangle[2].y >= 0) {
            largest = std::max(largest, error_of_triangle(heights, triangle, place.stride));
        }
    }
    return static_cast<float>(largest);
}

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
    // Where both margins share a place, errors with full margin are written last.
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

/// The code of a node's centre in a finished tile; those of the nodes east of it in the tile follow.
const std::byte& TileBuilder::centre_code(
    const GroundLayout::Level& level, int column, int row, MorphMargin morph_margin) const {
    const std::size_t in_tile = level.error_offset(NodePart::Centre, morph_margin, level.node_in_tile(column, row));
    return memory_[level.offset_of(level.tile_of(column, row)) + in_tile];
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
            std::memcpy(&children[index_of(
                            column - 2 * extent_.first_column + 1, row - 2 * extent_.first_row + 1, children_edge)],
                &centre_code(finer, column, row, morph_margin), static_cast<std::size_t>(count));
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
    const auto part = [&](NodePart which, int from_west, int from_south) {
        for (int row = 0; row < e.rows; ++row) {
            auto* const out =
                reinterpret_cast<std::int16_t*>(&tile_[e.at.height_offset(which, e.at.node_in_tile(0, row))]);
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
    part(NodePart::Centre, 1, 1);
    part(NodePart::South, 1, 0);
    part(NodePart::West, 0, 1);
}

void TileBuilder::write_errors(MorphMargin morph_margin) {
    const TileExtent& e = extent_;
    const Codes& own = codes_with(morph_margin);
    const auto part = [&](NodePart which, const std::vector<std::uint8_t>& codes, int pitch) {
        for (int row = 0; row < e.rows; ++row) {
            std::memcpy(&tile_[e.at.error_offset(which, morph_margin, e.at.node_in_tile(0, row))],
                &codes[index_of(0, row, pitch)], static_cast<std::size_t>(e.columns));
        }
    };
    part(NodePart::Centre, own.centres, e.columns);
    part(NodePart::South, own.souths, e.columns);
    part(NodePart::West, own.wests, e.columns + 1);
}

/// Writes the strips beyond the last row and column of nodes, where this tile borders on them.
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
//   (bisection_mesher.cpp). S = |d offset / d ln(distance)| / target error: the speed at which a
//   vertex may move. A vertex with a larger error moves at a larger distance, of which the eye's
//   motion is a smaller share. Therefore S grows with the smallest error that the sample can get, up
//   to where the target error's own changes count, which are equal at all distances. With the same
//   number of triangles the target error grows with the ground's relief, and S shrinks.
// - Errors are stored with this margin and without it. Where the target error E stays as it is from
//   frame to frame, vertices may move farther in target errors the smaller E is, up to S E0 pixels:
//   d E / (S E0) is enough, and errors between the two stored ones are nested as they are
//   (full_margin_px in bisection_selection.h).

namespace {

constexpr int lattice_levels = 5; ///< Nodes so far below have an edge of one lattice step.

/// S on rugged ground, for vertices that move near the eye and for those far off.
constexpr float rugged_near_morph_rate = 1.2F;
constexpr float rugged_far_morph_rate = 4.7F;
/// The least relief of rugged ground, and how many times larger S is on flat ground at most.
constexpr float rugged_m = 1200.0F;
constexpr float max_flatness_factor = 1.8F;
/// The largest error that moves near the eye, as a share of the ground's relief.
constexpr float near_error = 0.6F / 512.0F;

/// How many times larger S is than on rugged ground.
float flatness_factor(float relief_m) { return std::clamp(rugged_m / relief_m, 1.0F, max_flatness_factor); }

/// Raises each code of a row to at least that of another row.
void raise(std::span<const std::uint8_t> others, std::uint8_t* codes) {
    for (std::size_t i = 0; i < others.size(); ++i) { codes[i] = std::max(codes[i], others[i]); }
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

/// The largest code, without margin, of the centres of a finer level in a node of this level; 0 beyond the field.
std::uint8_t TileBuilder::largest_code(int level, int column, int row) const {
    const GroundLayout::Level& finer = layout_.level(level);
    const int across = 1 << (level - level_);
    std::uint8_t largest = 0;
    for (int y = std::max(row, 0) * across; y < std::min((row + 1) * across, finer.rows); ++y) {
        for (int x = std::max(column, 0) * across; x < std::min((column + 1) * across, finer.columns); ++x) {
            largest = std::max(largest, static_cast<std::uint8_t>(centre_code(finer, x, y, MorphMargin::None)));
        }
    }
    return largest;
}

/// The same for a node by its place in the tile, or next to the tile.
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

/// The least error of a sample with morph margin, given the largest code of those that need it and twice what the
/// ground moves by without it.
inline std::uint8_t TileBuilder::with_margin(std::uint8_t below, int twice) const {
    if (below == 0 || twice == 0) { return below; }
    const float error = coder_.steps_of(below);
    const float move = 0.5F * static_cast<float>(std::abs(twice));
    const float least = error + move * inverse_far_morph_rate_;
    const float fastest_move = std::clamp(morph_rate_by_error_ * least, near_morph_rate_, far_morph_rate_);
    return std::max(below, coder_.code_of(error + move / fastest_move));
}

/// Raises the codes of a row of samples to the least errors with morph margin, given the largest codes of those that
/// need them.
void TileBuilder::raise_to_margin(
    const SplitEdgeRow& edges, std::span<const std::uint8_t> below, std::uint8_t* codes) const {
    const int across = std::abs(edges.to_end[0]);
    const int up = edges.to_end[1];
    const int count = static_cast<int>(below.size());
    // So many have both ends within the field.
    const int columns_left = heights_.columns - 1 - across - edges.column;
    const bool low = edges.row + up < heights_.rows;
    const int inside = low && columns_left >= 0 ? std::min(count, columns_left / edges.step + 1) : 0;
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
