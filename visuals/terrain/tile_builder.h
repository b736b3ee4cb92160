#pragma once

#include "visuals/terrain/bisection_error.h"
#include "visuals/terrain/error_encoder.h"
#include "visuals/terrain/ground_layout.h"
#include "visuals/terrain/stored_heights.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// A tile by its level and its place among the level's tiles.
struct TileIndex {
    int level = 0;
    int column = 0;
    int row = 0;
};

/// How far a vertex may move at most, in wanted errors, while the wanted error changes by a small share of itself,
/// divided by that share: S of ground with this relief (tile_builder_errors.cpp).
float far_morph_rate_on(float relief_m);

/// Makes tiles one by one, heights and saturated errors, each after all tiles of the next finer level around it. There
/// is one builder for each thread; it reuses its memory, at most 10 MB.
class TileBuilder {
public:
    /// `memory` is GroundLayout memory in which height ranges and finished tiles of the finer level can be read and
    /// into which the strips are written. All arguments must outlive the builder.
    TileBuilder(const GroundLayout& layout, const StoredHeights& heights, const ErrorEncoder& coder,
        std::span<std::byte> memory);

    /// The bytes of a tile, valid until the next call. Also writes those parts of the strips that lie beside it.
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

    /// Codes of errors of one Room, row after row.
    struct Codes {
        std::vector<std::uint8_t> children; ///< Centres one level finer, one more on each side.
        std::vector<std::uint8_t> souths;   ///< One row more than nodes.
        std::vector<std::uint8_t> wests;    ///< One column more than nodes.
        std::vector<std::uint8_t> centres;
    };

    using RowOfCodes = std::span<const std::uint8_t>;
    using MarginRows = std::array<std::uint8_t*, 2>; ///< By Room.

    Codes& codes_with(MorphMargin morph_margin) { return codes_[static_cast<std::size_t>(morph_margin)]; }

    void choose_lattice();
    DiamondRow lattice_row(int column, int row, int count) const;
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
    /// S (tile_builder_errors.cpp) beside the eye, and the most it may be far off.
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
    /// For each node, and for one more on each side of the tile, the error that samples beside the lattice may have in
    /// a mesh of the lattice, in units of the numbers.
    std::vector<float> lattice_errors_;
    std::array<Codes, 2> codes_;                  ///< By Room.
    std::vector<std::uint8_t> unsaturated_codes_; ///< Those of a row, not saturated.
    std::vector<std::uint8_t> dependent_codes_;   ///< The largest of those that need the row's samples.
    std::vector<float> errors_;
    std::vector<std::byte> tile_;
};

} // namespace octant::visuals::terrain
