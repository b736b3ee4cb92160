#pragma once

#include "models/heights/height_field.h"
#include "visuals/terrain/bisection_tile_builder.h"
#include "visuals/terrain/bisection_tiles.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// The shape of a ground whose heights lie between two values: its unit is the finest power of two of a metre (not
/// below 2^-12) with which the range is at most 65,000 units, and its base is a whole number of units, so that whole
/// metres are stored exactly where the unit is at most 1 m.
GroundShape shape_of(int columns, int rows, double spacing_m, double lowest_m, double highest_m);

/// The stored number that is nearest to a height.
std::int16_t stored_number(float height_m, const GroundShape& shape);

/// The heights of a field whose numbers are metres, or stored numbers; `numbers` must outlive them. The limits are
/// whole metres in either form, so that both make the same ground.
StoredHeights stored_heights(std::span<const std::int16_t> numbers, const GroundShape& shape, bool has_integer_metres);

/// Statistics of the heights of a ground.
struct HeightStatistics {
    float lowest_m = 0.0F;
    float highest_m = 0.0F;
    float mean_m = 0.0F;
};

/// Fills GroundLayout memory from a field's numbers, tile by tile from the finest level up. Gives the same bytes for
/// any number of threads.
class GroundAssembler {
public:
    /// Takes a tile's bytes, to be put at `offset`; `index` counts the tiles as they lie in memory. Called by several
    /// threads, once for each tile. When it returns, the tile must be readable in `memory`.
    using TileSink = std::function<void(std::size_t index, std::size_t offset, std::span<const std::byte> bytes)>;

    /// `memory` has layout.total_bytes(); all of it but the tiles is written by this class. All arguments but the shape
    /// must outlive the assembly.
    GroundAssembler(const GroundShape& shape, const GroundLayout& layout, const StoredHeights& heights,
        std::span<std::byte> memory, int threads);

    /// Writes corners and height ranges, and returns the figures.
    HeightStatistics write_overview();

    /// The number of tiles of all levels. They are numbered in the order in which they are built.
    std::size_t tiles() const;

    /// Builds about `wanted` tiles from number `first` on, at least one, and returns the number of the next tile.
    std::size_t build(std::size_t first, std::size_t wanted, const TileSink& sink);

private:
    std::int64_t write_finest_ranges();
    void write_coarser_ranges(int level);

    HeightRange* ranges(int level) {
        return reinterpret_cast<HeightRange*>(memory_.data() + layout_.level(level).ranges);
    }

    GroundShape shape_;
    const GroundLayout& layout_;
    const StoredHeights& heights_;
    std::span<std::byte> memory_;
    int threads_;
    ErrorEncoder coder_;
    std::vector<TileBuilder> builders_; ///< One for each thread.
};

/// The heights and errors of a field, in memory of their own, so that the field is not needed afterwards. Heights are
/// rounded to the finest power of two of a metre with which the field's range fits into 16 bits. The same bytes for any
/// number of threads.
GroundTiles make_ground_tiles(const models::heights::HeightField& field, int threads = 2);

} // namespace octant::visuals::terrain
