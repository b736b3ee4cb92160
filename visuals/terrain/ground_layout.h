#pragma once

#include "visuals/terrain/error_codes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::terrain {

/// The three samples that a node of the quadtree owns. The middles of its north and east edges belong to the nodes
/// beyond.
enum class NodePart : std::uint8_t {
    Centre, ///< The middle of the node.
    South,  ///< The middle of its south edge.
    West    ///< The middle of its west edge.
};

/// Which of a sample's two errors: with the room that a vertex needs to move slowly while the wanted error changes from
/// frame to frame, or without any (tile_builder_errors.cpp).
enum class MorphMargin : std::uint8_t { Full, None };

/// The size of a ground and what its numbers mean.
struct GroundShape {
    int columns = 0; ///< Samples from west to east, 2 to 65,536.
    int rows = 0;    ///< Samples from south to north, 2 to 65,536.
    double spacing_m = 0.0;
    double height_base_m = 0.0; ///< The height of the stored number 0.
    double height_unit_m = 0.0; ///< The height of one unit; a power of two.
    /// Whether errors are stored without room, too; else those with full room stand for both.
    bool has_both_margins = true;
    /// Whether the steps between error codes suit the unit; else they are those of all grounds.
    bool has_unit_codes = true;
};

/// The lowest and highest stored height of a node's samples.
struct HeightRange {
    std::int16_t lowest = 0;
    std::int16_t highest = 0;
};

/// What the codes of a ground's errors mean.
ErrorCodes codes_of(const GroundShape& shape);

/// Where each number of a ground lies in one block of memory, in a file as in RAM.
///
/// The quadtree is that of quadtree.h: level 0 is the root, each level halves the edge, and the last level's edge is
/// two samples. The field is padded to a square of 2^n + 1 samples by its reflection (StoredHeights::padded_number),
/// and nodes wholly beyond it do not exist. Every sample but the root's four corners is a NodePart of exactly one node.
/// So heights and errors are each stored once, 3.5 bytes a sample, and the first levels alone are a coarser ground (an
/// image pyramid without repetition).
///
/// The nodes of a level lie in square tiles, tiles and the nodes in them row after row from the south. A tile holds all
/// its heights (Centre of all nodes, then South, then West; int16), then all its errors with full room (in the same
/// order, one byte each) and then those without room; but the finest level's Souths and Wests, which no sample needs,
/// have only one error. Beyond the last row and column of nodes there are strips: the Souths of the row beyond the
/// last, and the Wests of the column beyond.
///
/// The order in memory is corners, ranges, strips by level and then, from a page boundary on, tiles by level. Little
/// endian.
class GroundLayout {
public:
    static constexpr int tile_edge = 64; ///< In nodes; fewer where a level has fewer.
    /// The edge, in samples, of the smallest nodes that have height ranges.
    static constexpr int finest_range_edge = 32;
    static constexpr std::size_t page_bytes = 4096;

    /// A level of the tree. Offsets are in bytes from the beginning of the memory.
    struct Level {
        int columns = 0;    ///< In nodes.
        int rows = 0;       ///< In nodes.
        int edge = 0;       ///< The edge of a node in samples.
        int tile_shift = 0; ///< The logarithm (base 2) of the nodes along a tile's edge.
        int tiles_across = 0;
        int tiles_up = 0;
        std::size_t tile_nodes = 0;
        std::size_t tile_bytes = 0;
        /// By Room and NodePart: the offset in a tile of the nodes' errors.
        std::array<std::array<std::size_t, 3>, 2> errors{};
        std::size_t first_tile = 0; ///< The offset of the first tile.
        /// The offset of the Souths of row `rows`: int16 by column.
        std::size_t north_heights = 0;
        std::array<std::size_t, 2> north_errors{}; ///< Their errors by Room: bytes by column.
        /// The offset of the Wests of column `columns`: int16 by row.
        std::size_t east_heights = 0;
        std::array<std::size_t, 2> east_errors{}; ///< Their errors by Room: bytes by row.
        /// The offset of the HeightRanges of all nodes, row after row; only for edges >= 32 and level 0.
        std::size_t ranges = 0;
    };

    /// The layout of a field of so many samples; for `has_both_margins` see GroundShape.
    GroundLayout(int columns, int rows, bool has_both_margins = true);

    explicit GroundLayout(const GroundShape& shape) : GroundLayout(shape.columns, shape.rows, shape.has_both_margins) {}

    bool has_both_margins() const { return has_both_margins_; }

    int levels() const { return static_cast<int>(levels_.size()); }

    const Level& level(int index) const { return levels_[static_cast<std::size_t>(index)]; }

    /// The last level that has height ranges.
    int range_level() const { return range_level_; }

    /// The offset of the root's corners: four int16, south-west, south-east, north-west, north-east.
    std::size_t corners() const { return 0; }

    /// The offset at which the tiles begin, a multiple of page_bytes.
    std::size_t first_tile() const { return levels_.front().first_tile; }

    std::size_t total_bytes() const { return total_bytes_; }

private:
    void place_errors(Level& level, bool finest) const;

    bool has_both_margins_;
    std::vector<Level> levels_;
    int range_level_ = 0;
    std::size_t total_bytes_ = 0;
};

} // namespace octant::visuals::terrain
