#pragma once

#include "models/heights/height_field.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::terrain {

/// The one-byte codes of a ground's errors, as a table of metres: 0 for code 0 and ascending. An error's code is the
/// smallest whose metres are at or above it.
class ErrorCodes {
public:
    /// The codes of a ground that stores heights in units of so many metres, a power of two. It spans at most 65,000
    /// units, and its codes a quarter of a unit to 2^17 units. Successive codes differ by 3.6 % from 4 to 8192 units
    /// and by 15 % elsewhere, because smaller errors matter only to an eye close to the ground and larger errors are
    /// rare.
    explicit ErrorCodes(double height_unit_m);

    float metres(std::uint8_t code) const { return metres_[code]; }

    /// The code of an error; 255 for errors above the largest.
    std::uint8_t code_of(float error_m) const;

private:
    std::array<float, 256> metres_{};
};

/// The three samples that a node of the quadtree owns. The middles of its north and east edges belong to the nodes
/// beyond.
enum class NodePart : std::uint8_t {
    Centre, ///< The middle of the node.
    South,  ///< The middle of its south edge.
    West    ///< The middle of its west edge.
};

/// Which of a sample's two errors: Full includes the margin in which a vertex moves slowly while the target error
/// changes from frame to frame; None has no margin (bisection_tile_builder.cpp).
enum class MorphMargin : std::uint8_t { Full, None };

/// The size of a ground, and the units of its numbers.
struct GroundShape {
    int columns = 0; ///< Samples from west to east, 2 to 65,536.
    int rows = 0;    ///< Samples from south to north, 2 to 65,536.
    double spacing_m = 0.0;
    double height_base_m = 0.0; ///< The height of the stored number 0.
    double height_unit_m = 0.0; ///< The height of one unit; a power of two.
};

/// The lowest and highest stored height of a node's samples.
struct HeightRange {
    std::int16_t lowest = 0;
    std::int16_t highest = 0;
};

/// The offset of each number of a ground in one block of memory. It is the same in a file and in RAM.
///
/// The quadtree is that of quadtree.h: level 0 is the root, each level halves the edge, and the last level's edge is
/// two samples. The field is padded to a square of 2^n + 1 samples by its reflection (StoredHeights::padded_number),
/// and nodes wholly beyond it do not exist. Every sample but the root's four corners is a NodePart of exactly one node.
/// So heights and errors are each stored once, 3.5 bytes a sample, and the first levels alone are a coarser ground (an
/// image pyramid without repetition).
///
/// The nodes of a level lie in square tiles, tiles and the nodes in them row after row from the south. A tile holds all
/// its heights (Centre of all nodes, then South, then West; int16), then all its errors with full margin (in the same
/// order, one byte each) and then those without margin. No sample depends on the finest level's Souths and Wests, so
/// these have only one error. Beyond the last row and column of nodes there are strips: the Souths of the row beyond
/// the last, and the Wests of the column beyond.
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
        /// By MorphMargin and NodePart: the offset in a tile of the nodes' errors.
        std::array<std::array<std::size_t, 3>, 2> errors{};
        std::size_t first_tile = 0; ///< The offset of the first tile.
        /// The offset of the Souths of row `rows`: int16 by column.
        std::size_t north_heights = 0;
        std::array<std::size_t, 2> north_errors{}; ///< Their errors by MorphMargin: bytes by column.
        /// The offset of the Wests of column `columns`: int16 by row.
        std::size_t east_heights = 0;
        std::array<std::size_t, 2> east_errors{}; ///< Their errors by MorphMargin: bytes by row.
        /// The offset of the height ranges of all nodes, a HeightRange each, row after row; only for edges >= 32 and
        /// level 0.
        std::size_t ranges = 0;

        std::size_t tile_count() const {
            return static_cast<std::size_t>(tiles_across) * static_cast<std::size_t>(tiles_up);
        }

        /// The number of a node's tile as the level's tiles lie in memory.
        std::size_t tile_of(int column, int row) const {
            return static_cast<std::size_t>((row >> tile_shift) * tiles_across + (column >> tile_shift));
        }

        /// The number of a node in its tile.
        std::size_t node_in_tile(int column, int row) const {
            const int mask = (1 << tile_shift) - 1;
            return static_cast<std::size_t>(((row & mask) << tile_shift) + (column & mask));
        }

        /// The offset of a tile.
        std::size_t offset_of(std::size_t tile) const { return first_tile + tile * tile_bytes; }

        /// The offset in a tile of a node's stored height.
        std::size_t height_offset(NodePart part, std::size_t node) const {
            return sizeof(std::int16_t) * (static_cast<std::size_t>(part) * tile_nodes + node);
        }

        /// The offset in a tile of the code of a node's error.
        std::size_t error_offset(NodePart part, MorphMargin morph_margin, std::size_t node) const {
            return errors[static_cast<std::size_t>(morph_margin)][static_cast<std::size_t>(part)] + node;
        }
    };

    /// The layout of a field of so many samples.
    GroundLayout(int columns, int rows);

    explicit GroundLayout(const GroundShape& shape) : GroundLayout(shape.columns, shape.rows) {}

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
    static void place_errors(Level& level, bool finest);

    std::vector<Level> levels_;
    int range_level_ = 0;
    std::size_t total_bytes_ = 0;
};

/// Records which tiles of a ground may be read, and validates each other tile at its first access. Thread-safe. This
/// base class trusts all tiles; it serves grounds made in memory.
class TileValidator {
public:
    explicit TileValidator(const GroundLayout& layout) : TileValidator(layout, true) {}

    virtual ~TileValidator() = default;
    TileValidator(const TileValidator&) = delete;
    TileValidator& operator=(const TileValidator&) = delete;
    TileValidator(TileValidator&&) = delete;
    TileValidator& operator=(TileValidator&&) = delete;

    /// Returns once a tile, counted as its level's tiles lie in memory, may be read.
    void ensure_valid(int level, std::size_t tile) const {
        if (ready_[first_[static_cast<std::size_t>(level)] + tile].load(std::memory_order_acquire) == 0) [[unlikely]] {
            validate(level, tile);
        }
    }

protected:
    TileValidator(const GroundLayout& layout, bool is_trusted) {
        std::size_t tiles = 0;
        for (int level = 0; level < layout.levels(); ++level) {
            const GroundLayout::Level& at = layout.level(level);
            first_.push_back(tiles);
            tiles += at.tile_count();
        }
        ready_ = std::make_unique<std::atomic<std::uint8_t>[]>(tiles);
        for (std::size_t tile = 0; tile < tiles; ++tile) {
            ready_[tile].store(is_trusted ? 1 : 0, std::memory_order_relaxed);
        }
    }

    /// The number of a tile among those of all levels.
    std::size_t index_of(int level, std::size_t tile) const { return first_[static_cast<std::size_t>(level)] + tile; }

    bool is_valid(std::size_t index) const { return ready_[index].load(std::memory_order_acquire) != 0; }

    void set_valid(std::size_t index) const { ready_[index].store(1, std::memory_order_release); }

private:
    virtual void validate(int level, std::size_t tile) const { set_valid(index_of(level, tile)); }

    std::vector<std::size_t> first_; ///< For each level the number of its first tile.
    std::unique_ptr<std::atomic<std::uint8_t>[]> ready_;
};

/// The metadata of a ground.
struct GroundMetadata {
    std::string name;
    std::optional<GeoPosition> place;                        ///< Nothing for made ground.
    std::optional<models::heights::CoordinateSystem> system; ///< As HeightField::system.
    std::int64_t filled_voids = 0;                           ///< Samples without data that were filled.
    float lowest_m = 0.0F;
    float highest_m = 0.0F;
    float mean_m = 0.0F;
    /// The deviation from the imported files; nothing where it was not measured.
    std::optional<models::heights::HeightDeviation> deviation = {};
};

/// The heights of a ground and, for each sample that a mesh may leave out, the error of leaving it out: all that meshes
/// by screen-space error are made from. It reads GroundLayout memory, which may be a mapped file. World axes as in
/// HeightField: x east, y north, z up, metres, with the origin at the field's centre at datum; column 0 is west and row
/// 0 south.
///
/// The error of a sample refers to the longest-edge bisection of the field. A sample halves the longest edge of two
/// triangles (of one at the border). Its own error is the largest vertical distance of the field's samples from those
/// two triangles. Stored is the largest of its own error and those of all samples that need it (the saturated error),
/// once with the morph margin and once without it, so that errors never grow from a sample to one that needs it. The
/// middle of an edge needs the centres of both nodes that share the edge. The centre of a node needs the middles of two
/// edges of its parent: those two of its corners that are neither its parent's centre nor its parent's corner.
class GroundTiles {
public:
    /// `memory` is laid out as GroundLayout(shape) says (its size is asserted) and kept alive by `owner`. A tile is
    /// read after `validator` has let it; null trusts all tiles.
    GroundTiles(const GroundShape& shape, GroundMetadata metadata, std::span<const std::byte> memory,
        std::shared_ptr<const void> owner, std::shared_ptr<const TileValidator> validator = nullptr);

    const GroundShape& shape() const { return shape_; }

    const GroundMetadata& metadata() const { return metadata_; }

    const GroundLayout& layout() const { return layout_; }

    /// The bytes of a tile may be read after validator().ensure_valid() has returned for it.
    std::span<const std::byte> memory() const { return memory_; }

    std::span<const std::byte> tile(int level, std::size_t index) const {
        return memory_.subspan(layout_.level(level).offset_of(index), layout_.level(level).tile_bytes);
    }

    const TileValidator& validator() const { return *validator_; }

    int levels() const { return layout_.levels(); }

    int columns() const { return shape_.columns; }

    int rows() const { return shape_.rows; }

    double spacing_m() const { return shape_.spacing_m; }

    /// The height of one of the root's corners: south-west, south-east, north-west, north-east.
    float corner_m(unsigned corner) const { return height_of(heights_at(layout_.corners())[corner]); }

    /// The height of a sample by its node. South may be asked also for row rows(level), and West also for column
    /// columns(level), each one beyond the last node.
    float height_m(int level, NodePart part, int column, int row) const {
        return height_of(stored_height(level, part, column, row));
    }

    /// The code of a sample's error by its node, as for height_m; codes() make it metres. It is 0 only where the error
    /// is 0.
    std::uint8_t error_code(
        int level, NodePart part, int column, int row, MorphMargin morph_margin = MorphMargin::Full) const {
        return *stored_error(level, part, column, row, morph_margin);
    }

    const ErrorCodes& codes() const { return codes_; }

    /// A lower bound of all samples of a node, for levels up to layout().range_level(); finer nodes have no bounds of
    /// their own.
    float lowest_m(int level, int column, int row) const { return height_of(range(level, column, row).lowest); }

    /// The upper bound, for the same levels.
    float highest_m(int level, int column, int row) const { return height_of(range(level, column, row).highest); }

    /// The height of any sample (asserted to be one).
    float height_m(int column, int row) const;

    /// The heights of all samples of a row, from west to east, at a tenth of the cost of asking for each.
    void copy_row(int row, std::span<float> heights_m) const;

    /// Half the extent of the field from its centre, east and north, metres.
    glm::dvec2 half_extent_m() const;

    /// The height of the ground between samples (bilinear); nothing outside the field.
    std::optional<double> height_at(double x_m, double y_m) const;

private:
    /// The height as it is stored; arguments as for height_m.
    std::int16_t stored_height(int level, NodePart part, int column, int row) const {
        const GroundLayout::Level& at = layout_.level(level);
        if (row == at.rows) { return heights_at(at.north_heights)[column]; }
        if (column == at.columns) { return heights_at(at.east_heights)[row]; }
        return *heights_at(valid_tile(level, column, row) + at.height_offset(part, at.node_in_tile(column, row)));
    }

    float height_of(std::int16_t stored) const {
        return static_cast<float>(base_m_ + unit_m_ * static_cast<double>(stored));
    }

    const std::int16_t* heights_at(std::size_t offset) const {
        return reinterpret_cast<const std::int16_t*>(memory_.data() + offset);
    }

    const HeightRange& range(int level, int column, int row) const {
        const GroundLayout::Level& at = layout_.level(level);
        return reinterpret_cast<const HeightRange*>(
            memory_.data() + at.ranges)[static_cast<std::size_t>(row) * static_cast<std::size_t>(at.columns) +
                                        static_cast<std::size_t>(column)];
    }

    void copy_parts(int level, NodePart part, int row, std::span<float> heights_m) const;

    /// The offset of a node's tile, which may then be read.
    std::size_t valid_tile(int level, int column, int row) const {
        const GroundLayout::Level& at = layout_.level(level);
        const std::size_t tile = at.tile_of(column, row);
        validator_->ensure_valid(level, tile);
        return at.offset_of(tile);
    }

    const std::uint8_t* stored_error(int level, NodePart part, int column, int row, MorphMargin morph_margin) const {
        const GroundLayout::Level& at = layout_.level(level);
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(memory_.data());
        if (row == at.rows) { return bytes + at.north_errors[static_cast<std::size_t>(morph_margin)] + column; }
        if (column == at.columns) { return bytes + at.east_errors[static_cast<std::size_t>(morph_margin)] + row; }
        return bytes + valid_tile(level, column, row) +
               at.error_offset(part, morph_margin, at.node_in_tile(column, row));
    }

    GroundShape shape_;
    GroundMetadata metadata_;
    GroundLayout layout_;
    ErrorCodes codes_;
    std::span<const std::byte> memory_;
    std::shared_ptr<const void> owner_;
    std::shared_ptr<const TileValidator> validator_;
    double base_m_;
    double unit_m_;
};

} // namespace octant::visuals::terrain
