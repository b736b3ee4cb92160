#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::terrain {

/// The three samples that a node of the quadtree owns. Those in the middle of its north and east
/// edges belong to the nodes beyond.
enum class NodePart : std::uint8_t {
    Centre, ///< middle of the node
    South,  ///< middle of its south edge
    West    ///< middle of its west edge
};

/// Size of a ground and what its numbers mean.
struct GroundShape {
    int columns = 0; ///< samples from west to east, 2 to 65,536
    int rows = 0;    ///< samples from south to north, 2 to 65,536
    double spacing_m = 0.0;
    double height_base_m = 0.0; ///< height of the stored number 0
    double height_unit_m = 0.0; ///< height of one step; a power of two
};

/// Lowest and highest stored height.
struct HeightRange {
    std::int16_t lowest = 0;
    std::int16_t highest = 0;
};

/// Where each number of a ground lies in one block of memory, in a file as in RAM.
///
/// A quadtree as in quadtree.h: level 0 is the root, each level halves the edge, the last level's
/// edge is two samples; the field is padded to a square of 2^n + 1 samples by repeating its last
/// column and row in place, and nodes without area do not exist. Every sample but the root's four
/// corners is a NodePart of exactly one node, so that heights and errors by node are each stored
/// once: 3 bytes a sample, and the first levels alone are a coarser ground (a pyramid without
/// repetition).
///
/// Nodes of a level lie in square tiles, tiles and nodes in them row after row from the south. A
/// tile holds all heights (Centre of all its nodes, then South, then West; int16), then all errors
/// (likewise, one byte). Beyond the last row and column of nodes lie strips: the Souths of the row
/// above the last, the Wests of the column beyond.
///
/// The order in memory: corners, ranges, strips by level, then (from a page boundary on) tiles by
/// level. Little endian.
class GroundLayout {
public:
    static constexpr int tile_edge = 64;         ///< nodes; fewer where a level has fewer
    static constexpr int finest_range_edge = 32; ///< samples of the smallest nodes with ranges
    static constexpr std::size_t page_bytes = 4096;

    struct Level {
        int columns = 0;    ///< nodes
        int rows = 0;       ///< nodes
        int edge = 0;       ///< samples of a node
        int tile_shift = 0; ///< log2 of the nodes on an edge of a tile
        int tiles_across = 0;
        int tiles_up = 0;
        std::size_t tile_nodes = 0;
        std::size_t tile_bytes = 0;
        std::size_t first_tile = 0;    ///< offset, bytes
        std::size_t north_heights = 0; ///< offset of the Souths of row `rows`: int16 by column
        std::size_t north_errors = 0;  ///< bytes by column
        std::size_t east_heights = 0;  ///< offset of the Wests of column `columns`: int16 by row
        std::size_t east_errors = 0;   ///< bytes by row
        std::size_t ranges =
            0; ///< offset, HeightRange by node row after row; edge >= 32 or level 0
    };

    /// `columns` and `rows`: samples.
    GroundLayout(int columns, int rows);

    int levels() const { return static_cast<int>(levels_.size()); }

    const Level& level(int index) const { return levels_[static_cast<std::size_t>(index)]; }

    /// The last level with ranges.
    int range_level() const { return range_level_; }

    /// Four int16: south-west, south-east, north-west, north-east.
    std::size_t corners() const { return 0; }

    /// Where the tiles begin, a multiple of page_bytes.
    std::size_t first_tile() const { return levels_.front().first_tile; }

    std::size_t total_bytes() const { return total_bytes_; }

private:
    std::vector<Level> levels_;
    int range_level_ = 0;
    std::size_t total_bytes_ = 0;
};

} // namespace octant::visuals::terrain
