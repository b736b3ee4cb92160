// Builds a ground in memory from a height field that is in memory: for made ground and small files. Large files are
// imported into a mapped file instead (ground_import.cpp), by the same GroundAssembler.
#include "visuals/terrain/bisection_ground_builder.h"

#include "sim/base/thread_pool.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

namespace octant::visuals::terrain {

// Builds a ground bottom-up, step 1 and 2 of the quadtree paper (E. K. Choi, B. S. Shin, section 2: each leaf's error
// metric, propagated to the parents), here for the bisection's saturated errors and out of core: a tile needs only the
// adjacent tiles of the next finer level.

namespace {

constexpr HeightRange no_range = {std::numeric_limits<std::int16_t>::max(), std::numeric_limits<std::int16_t>::min()};

HeightRange joined(HeightRange a, HeightRange b) {
    return {std::min(a.lowest, b.lowest), std::max(a.highest, b.highest)};
}

HeightRange range_of(std::span<const std::int16_t> numbers) {
    HeightRange range = no_range;
    for (const std::int16_t number : numbers) {
        range.lowest = std::min(range.lowest, number);
        range.highest = std::max(range.highest, number);
    }
    return range;
}

} // namespace

GroundShape shape_of(int columns, int rows, double spacing_m, double lowest_m, double highest_m) {
    constexpr double max_units = 65000.0;
    double unit_m = 0x1p-12;
    while (highest_m - lowest_m > max_units * unit_m) { unit_m *= 2.0; }
    const double base_m = std::round(0.5 * (lowest_m + highest_m) / unit_m) * unit_m;
    return {columns, rows, spacing_m, base_m, unit_m};
}

std::int16_t stored_number(float height_m, const GroundShape& shape) {
    // Adding this number leaves no bits for a fraction, so that the lowest bits hold the rounded number.
    constexpr double no_fraction = 0x1.8p52;
    const double number = (static_cast<double>(height_m) - shape.height_base_m) / shape.height_unit_m;
    return static_cast<std::int16_t>(std::bit_cast<std::int64_t>(number + no_fraction));
}

StoredHeights stored_heights(std::span<const std::int16_t> numbers, const GroundShape& shape, bool has_integer_metres) {
    StoredHeights heights{numbers, shape.columns, shape.rows, 1, 0, shape.height_unit_m};
    const double base_m = shape.height_base_m;
    double lowest_m = std::ceil(base_m - 32768.0 * shape.height_unit_m);
    double highest_m = std::floor(base_m + 32767.0 * shape.height_unit_m);
    if (std::abs(base_m) <= 32000.0) { // metres must be 16-bit numbers, too
        lowest_m = std::max(lowest_m, -32768.0);
        highest_m = std::min(highest_m, 32767.0);
    }
    if (has_integer_metres) {
        heights.multiplier = static_cast<int>(1.0 / shape.height_unit_m);
        heights.addend = static_cast<int>(-base_m / shape.height_unit_m);
        heights.number_unit_m = 1.0;
        heights.lowest = static_cast<int>(lowest_m);
        heights.highest = static_cast<int>(highest_m);
    } else {
        heights.lowest = static_cast<int>((lowest_m - base_m) / shape.height_unit_m);
        heights.highest = static_cast<int>((highest_m - base_m) / shape.height_unit_m);
    }
    return heights;
}

GroundAssembler::GroundAssembler(const GroundShape& shape, const GroundLayout& layout, const StoredHeights& heights,
    std::span<std::byte> memory, int threads)
    : shape_(shape), layout_(layout), heights_(heights), memory_(memory), threads_(threads),
      coder_(ErrorCodes(shape.height_unit_m), heights.number_unit_m) {
    assert(threads >= 1);
    for (int thread = 0; thread < threads; ++thread) { builders_.emplace_back(layout_, heights_, coder_, memory_); }
}

HeightStatistics GroundAssembler::write_overview() {
    const int edge = layout_.level(0).edge;
    const std::array<std::int16_t, 4> corners = {heights_.stored(heights_.number(0, 0)),
        heights_.stored(heights_.padded_number(edge, 0)), heights_.stored(heights_.padded_number(0, edge)),
        heights_.stored(heights_.padded_number(edge, edge))};
    std::memcpy(memory_.data() + layout_.corners(), corners.data(), sizeof corners);
    const std::int64_t sum = write_finest_ranges();
    for (int level = layout_.range_level() - 1; level >= 0; --level) { write_coarser_ranges(level); }
    const auto metres = [this](double stored) {
        return static_cast<float>(shape_.height_base_m + shape_.height_unit_m * stored);
    };
    const double count = static_cast<double>(heights_.columns) * heights_.rows;
    const double mean_number = static_cast<double>(sum) / count;
    return {metres(ranges(0)->lowest), metres(ranges(0)->highest),
        metres(mean_number * heights_.multiplier + heights_.addend)};
}

/// Writes the height ranges of the finest level that has them. Returns the sum of all numbers.
std::int64_t GroundAssembler::write_finest_ranges() {
    const GroundLayout::Level& at = layout_.level(layout_.range_level());
    std::vector<std::int64_t> sums(static_cast<std::size_t>(at.rows));
    parallel_for(sums.size(), threads_, [&](std::size_t index, std::size_t /*worker*/) {
        const int node_row = static_cast<int>(index);
        HeightRange* const out = ranges(layout_.range_level()) + index * static_cast<std::size_t>(at.columns);
        std::fill_n(out, at.columns, no_range);
        const int south = node_row * at.edge;
        const int north = std::min(south + at.edge, heights_.rows - 1);
        for (int row = south; row <= north; ++row) {
            const auto numbers =
                heights_.numbers.subspan(static_cast<std::size_t>(row) * static_cast<std::size_t>(heights_.columns),
                    static_cast<std::size_t>(heights_.columns));
            for (int column = 0; column < at.columns; ++column) {
                const int west = column * at.edge;
                const int count = std::min(at.edge + 1, heights_.columns - west);
                const auto piece = numbers.subspan(static_cast<std::size_t>(west), static_cast<std::size_t>(count));
                out[column] = joined(out[column], range_of(piece));
            }
            if (row < north || row == heights_.rows - 1) {
                sums[index] = std::accumulate(numbers.begin(), numbers.end(), sums[index]);
            }
        }
        for (int column = 0; column < at.columns; ++column) {
            out[column] = {heights_.stored(out[column].lowest), heights_.stored(out[column].highest)};
        }
    });
    return std::accumulate(sums.begin(), sums.end(), std::int64_t{0});
}

/// Writes the height ranges of a level from those of the next finer one.
void GroundAssembler::write_coarser_ranges(int level) {
    const GroundLayout::Level& at = layout_.level(level);
    const GroundLayout::Level& finer = layout_.level(level + 1);
    HeightRange* out = ranges(level);
    for (int row = 0; row < at.rows; ++row) {
        for (int column = 0; column < at.columns; ++column) {
            *out = no_range;
            for (int y = 2 * row; y < std::min(2 * row + 2, finer.rows); ++y) {
                for (int x = 2 * column; x < std::min(2 * column + 2, finer.columns); ++x) {
                    *out = joined(*out, ranges(level + 1)[y * finer.columns + x]);
                }
            }
            ++out;
        }
    }
}

std::size_t GroundAssembler::tiles() const {
    std::size_t count = 0;
    for (int level = 0; level < layout_.levels(); ++level) { count += layout_.level(level).tile_count(); }
    return count;
}

std::size_t GroundAssembler::build(std::size_t first, std::size_t wanted, const TileSink& sink) {
    int level = layout_.levels() - 1;
    std::size_t begin = 0;
    while (first >= begin + layout_.level(level).tile_count()) {
        begin += layout_.level(level).tile_count();
        --level;
        assert(level >= 0);
    }
    const GroundLayout::Level& at = layout_.level(level);
    const std::size_t count = std::min(wanted, begin + at.tile_count() - first);
    const std::size_t coarser = tiles() - begin - at.tile_count();
    parallel_for(count, threads_, [&](std::size_t index, std::size_t worker) {
        const std::size_t tile = first + index - begin;
        const auto across = static_cast<std::size_t>(at.tiles_across);
        const TileIndex place{level, static_cast<int>(tile % across), static_cast<int>(tile / across)};
        sink(coarser + tile, at.offset_of(tile), builders_[worker].build(place));
    });
    return first + count;
}

namespace {

std::vector<std::int16_t> numbers_of(const models::heights::HeightField& field, const GroundShape& shape, int threads) {
    const auto columns = static_cast<std::size_t>(shape.columns);
    std::vector<std::int16_t> numbers(columns * static_cast<std::size_t>(shape.rows));
    parallel_for(static_cast<std::size_t>(shape.rows), threads, [&](std::size_t row, std::size_t /*w*/) {
        for (std::size_t column = 0; column < columns; ++column) {
            const float height_m = field.height_m(static_cast<int>(column), static_cast<int>(row));
            numbers[row * columns + column] = stored_number(height_m, shape);
        }
    });
    return numbers;
}

} // namespace

GroundTiles make_ground_tiles(const models::heights::HeightField& field, int threads) {
    const GroundShape shape = shape_of(field.columns(), field.rows(), field.spacing_m(),
        static_cast<double>(field.lowest_m()), static_cast<double>(field.highest_m()));
    const std::vector<std::int16_t> numbers = numbers_of(field, shape, threads);
    const StoredHeights heights = stored_heights(numbers, shape, false);
    const GroundLayout layout(shape);
    const std::shared_ptr<std::byte[]> memory(new std::byte[layout.total_bytes()]);
    std::memset(memory.get(), 0, layout.first_tile());
    const std::span<std::byte> bytes(memory.get(), layout.total_bytes());
    GroundAssembler assembly(shape, layout, heights, bytes, threads);
    const HeightStatistics figures = assembly.write_overview();
    const auto put = [&bytes](std::size_t /*index*/, std::size_t offset, std::span<const std::byte> tile) {
        std::memcpy(bytes.data() + offset, tile.data(), tile.size());
    };
    for (std::size_t tile = 0; tile < assembly.tiles();) { tile = assembly.build(tile, assembly.tiles(), put); }
    const GroundMetadata metadata{
        field.name, field.place, field.system, field.filled_voids, figures.lowest_m, figures.highest_m, figures.mean_m};
    return {shape, metadata, bytes, memory};
}

} // namespace octant::visuals::terrain
