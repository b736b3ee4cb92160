#pragma once

#include "visuals/terrain/bisection_tiles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// ErrorCodes::code_of for errors given in units of the stored numbers, by table: the leading bits of a float select a
/// code, and one comparison corrects it.
class ErrorEncoder {
public:
    ErrorEncoder(const ErrorCodes& codes, double unit_m) : unit_m_(static_cast<float>(unit_m)), metres_(codes) {
        for (std::size_t code = 0; code < steps_.size(); ++code) {
            steps_[code] = codes.metres(static_cast<std::uint8_t>(code)) / unit_m_;
        }
        first_ = bin_of(metres_.metres(1));
        const std::uint32_t last = bin_of(metres_.metres(255)) + 1;
        for (std::uint32_t bin = first_; bin <= last; ++bin) {
            const auto lowest_m = std::bit_cast<float>(bin << dropped_bits);
            codes_.push_back(metres_.code_of(lowest_m));
        }
    }

    std::uint8_t code_of(float steps) const {
        const float error_m = steps * unit_m_;
        const std::uint32_t bin = bin_of(error_m);
        if (bin < first_) { return error_m > 0.0F ? 1 : 0; }
        const std::uint8_t code = codes_[std::min<std::size_t>(bin - first_, codes_.size() - 1)];
        return static_cast<std::uint8_t>(code + (code < 255 && error_m > metres_.metres(code) ? 1 : 0));
    }

    /// The error of a code in units of the stored numbers.
    float steps_of(std::uint8_t code) const { return steps_[code]; }

private:
    /// A bin spans 1/64 to 1/32 of an octave, which is narrower than the step between two codes.
    static constexpr unsigned dropped_bits = 17;

    static std::uint32_t bin_of(float error_m) { return std::bit_cast<std::uint32_t>(error_m) >> dropped_bits; }

    float unit_m_;
    ErrorCodes metres_;
    std::array<float, 256> steps_{};
    std::uint32_t first_ = 0;
    std::vector<std::uint8_t> codes_;
};

/// A field's heights as whole numbers, row after row from the south. The ground stores number * multiplier + addend.
struct StoredHeights {
    std::span<const std::int16_t> numbers;
    int columns = 0;
    int rows = 0;
    int multiplier = 1;
    int addend = 0;
    double number_unit_m = 1.0; ///< The height difference of two successive numbers.
    int lowest = -32768;        ///< The limits of padded_number.
    int highest = 32767;

    std::int16_t number(int column, int row) const {
        return numbers[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(column)];
    }

    /// The number at a place of the padded square. Beyond the last column and row the field goes on as its reflection
    /// in the point on its border, so that slopes do not bend there.
    std::int16_t padded_number(int column, int row) const {
        const int last_column = std::min(column, columns - 1);
        const int last_row = std::min(row, rows - 1);
        if (column == last_column && row == last_row) { return number(column, row); }
        const int west = std::max(2 * last_column - column, 0);
        const int south = std::max(2 * last_row - row, 0);
        const auto reflected = [&](int at_row) { return 2 * number(last_column, at_row) - number(west, at_row); };
        const int value = 2 * reflected(last_row) - reflected(south);
        return static_cast<std::int16_t>(std::clamp(value, lowest, highest));
    }

    std::int16_t stored(std::int16_t number) const { return static_cast<std::int16_t>(number * multiplier + addend); }
};

/// A diamond: two triangles of the longest-edge bisection that share their hypotenuse. The sample in the middle of the
/// hypotenuse splits both.
enum class Diamond : std::uint8_t {
    Rising,  ///< A square node, cut from its south-west corner to its north-east one.
    Falling, ///< A square node, cut from its north-west corner to its south-east one.
    Lying,   ///< A square on its corner, cut from west to east.
    Upright  ///< A square on its corner, cut from south to north.
};

/// A row of samples, each the middle of a diamond of the same size.
struct DiamondRow {
    const std::int16_t* first_middle = nullptr;
    std::ptrdiff_t pitch = 0; ///< How many numbers one row of the field is from the next.
    /// The distance from a middle to the ends of its hypotenuse along an axis, in samples: a power of two from 1 to 16.
    /// The next middle is twice as far away.
    int half = 1;
    int count = 0;
};

/// A tile by its level and its place among the level's tiles.
struct TileIndex {
    int level = 0;
    int column = 0;
    int row = 0;
};

/// The largest S of ground with this relief. S = |d offset / d ln(distance)| / target error, where the offset is
/// how far a vertex is from its sample; bisection_tile_builder.cpp derives it.
float far_morph_rate_on(float relief_m);

/// Makes tiles one by one, heights and saturated errors, each after all tiles of the next finer level around it. There
/// is one builder for each thread; it reuses its memory, at most 10 MB.
class TileBuilder {
public:
    /// `memory` is GroundLayout memory in which height ranges and finished tiles of the finer level can be read and
    /// into which the strips are written. All arguments must outlive the builder.
    TileBuilder(const GroundLayout& layout, const StoredHeights& heights, const ErrorEncoder& coder,
        std::span<std::byte> memory);

    /// The bytes of a tile, valid until the next call. Also writes the parts of the strips next to the tile.
    std::span<const std::byte> build(const TileIndex& place);

private:
    /// The nodes of a tile, and what they have in common.
    struct TileExtent {
        GroundLayout::Level at;
        int first_column = 0;
        int first_row = 0;
        int columns = 0;
        int rows = 0;
        int half = 0;   ///< Half a node's edge in samples.
        int stride = 1; ///< The distance in samples between those that are looked at.
    };

    static constexpr int tile_edge_nodes = GroundLayout::tile_edge;
    static constexpr int children_edge = 2 * tile_edge_nodes + 2;

    /// A row of samples, each the middle of two triangles' longest edge, in samples of the field.
    struct SplitEdgeRow {
        int column = 0; ///< Of the first.
        int row = 0;
        int step = 0;                ///< From one to the next.
        std::array<int, 2> to_end{}; ///< From the first to the edge's northern or eastern end.
        bool alternate = false;      ///< Every second edge leans the other way.
    };

    /// Codes of errors of one MorphMargin, row after row.
    struct Codes {
        std::vector<std::uint8_t> children; ///< Centres one level finer, one more on each side.
        std::vector<std::uint8_t> souths;   ///< One row more than nodes.
        std::vector<std::uint8_t> wests;    ///< One column more than nodes.
        std::vector<std::uint8_t> centres;
    };

    using RowOfCodes = std::span<const std::uint8_t>;
    using MarginRows = std::array<std::uint8_t*, 2>; ///< By MorphMargin.

    Codes& codes_with(MorphMargin morph_margin) { return codes_[static_cast<std::size_t>(morph_margin)]; }

    void choose_lattice();
    DiamondRow lattice_row(int column, int row, int count) const;
    const std::byte& centre_code(const GroundLayout::Level& level, int column, int row, MorphMargin morph_margin) const;
    void fetch_children(MorphMargin morph_margin);
    void fetch_lattice_errors();
    std::uint8_t largest_code(int level, int column, int row) const;
    float lattice_error(int column, int row) const;
    float lattice_error_by(int index, int row, Diamond diamond) const;
    void fetch_middles(const Codes& codes, int row, std::span<std::uint8_t> largest) const;
    void measure_relief();
    void measure_souths();
    void measure_wests();
    void measure_centres();
    void measure(int row, Diamond diamond, std::span<std::uint8_t> codes);
    std::uint8_t with_margin(std::uint8_t below, int twice) const;
    void raise_to_margin(const SplitEdgeRow& edges, RowOfCodes below, std::uint8_t* codes) const;
    void saturate_middles(
        const SplitEdgeRow& edges, std::size_t children, const RowOfCodes& own, const MarginRows& out);
    std::int16_t height(int column, int row) const;
    void write_heights();
    void write_errors(MorphMargin morph_margin);
    void write_strips();

    const GroundLayout& layout_;
    const StoredHeights& heights_;
    const ErrorEncoder& coder_;
    std::span<std::byte> memory_;
    int level_ = 0;
    /// S (bisection_tile_builder.cpp) near the eye, and its maximum far off.
    float near_morph_rate_ = 0.0F;
    float far_morph_rate_ = 0.0F;
    float inverse_far_morph_rate_ = 0.0F; ///< 1 / far_morph_rate_
    /// S over the error in numbers, between the two.
    float morph_rate_by_error_ = 0.0F;
    TileExtent extent_;
    std::vector<std::int16_t> lattice_copy_; ///< Every stride-th sample around the tile.
    const std::int16_t* lattice_ = nullptr;
    std::ptrdiff_t pitch_ = 0;
    int lattice_column_ = 0; ///< The column of lattice_[0] in samples.
    int lattice_row_ = 0;
    /// For each node, and for one more on each side of the tile, the error that samples off the lattice may have in a
    /// mesh of the lattice, in units of the numbers.
    std::vector<float> lattice_errors_;
    std::array<Codes, 2> codes_;                  ///< By MorphMargin.
    std::vector<std::uint8_t> unsaturated_codes_; ///< Those of a row, not saturated.
    std::vector<std::uint8_t> dependent_codes_;   ///< The largest of those that need the row's samples.
    std::vector<float> errors_;
    std::vector<std::byte> tile_;
};

} // namespace octant::visuals::terrain
