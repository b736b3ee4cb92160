// Errors of longest-edge bisection: P. Lindstrom, V. Pascucci, "Visualization of Large Terrains Made Easy", 2001,
// section 2 (bisection and diamonds).
//
// The heights of both triangles of a diamond form a single function that is linear but for one absolute value (of x, of
// y or of x - y), so that rows need no case distinctions and several samples are computed at once. All sums stay below
// 24 bits, so floats are exact here and the order of operations does not matter.
//
// Deviation: the error of a diamond is the true largest deviation of all samples inside, not that of its middle alone.
#include "visuals/terrain/bisection_error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>

#define OCTANT_INLINE __attribute__((always_inline)) inline

namespace octant::visuals::terrain {

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

} // namespace

void diamond_errors(const DiamondRow& row, Diamond diamond, float* errors) { run_kernel(row, diamond, false, errors); }

void node_errors(const DiamondRow& row, Diamond first, float* errors) {
    assert(first == Diamond::Rising || first == Diamond::Falling);
    run_kernel(row, first, true, errors);
}

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

} // namespace octant::visuals::terrain
