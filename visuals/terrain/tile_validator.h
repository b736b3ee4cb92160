#pragma once

#include "visuals/terrain/ground_layout.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace octant::visuals::terrain {

/// Knows which tiles of a ground may be read, and makes the others fit to be read when they are first asked for. Any
/// thread may ask. This one trusts all tiles: for grounds made in memory.
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
            tiles += static_cast<std::size_t>(at.tiles_across) * static_cast<std::size_t>(at.tiles_up);
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

} // namespace octant::visuals::terrain
