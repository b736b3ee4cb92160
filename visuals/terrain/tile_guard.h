#pragma once

#include "visuals/terrain/ground_layout.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace octant::visuals::terrain {

/// Knows which tiles of a ground may be read, and makes the others fit to be read when they are
/// first asked for. Any thread may ask. This one trusts all tiles: for grounds made in memory.
class TileGuard {
public:
    explicit TileGuard(const GroundLayout& layout)
        : TileGuard(layout, true) {}

    virtual ~TileGuard() = default;
    TileGuard(const TileGuard&) = delete;
    TileGuard& operator=(const TileGuard&) = delete;
    TileGuard(TileGuard&&) = delete;
    TileGuard& operator=(TileGuard&&) = delete;

    /// Returns once a tile, counted as its level's tiles lie in memory, may be read.
    void require(int level, std::size_t tile) const {
        if (ready_[first_[static_cast<std::size_t>(level)] + tile].load(
                std::memory_order_acquire) == 0) [[unlikely]] {
            make_ready(level, tile);
        }
    }

protected:
    TileGuard(const GroundLayout& layout, bool trusts) {
        std::size_t tiles = 0;
        for (int level = 0; level < layout.levels(); ++level) {
            const GroundLayout::Level& at = layout.level(level);
            first_.push_back(tiles);
            tiles +=
                static_cast<std::size_t>(at.tiles_across) * static_cast<std::size_t>(at.tiles_up);
        }
        ready_ = std::make_unique<std::atomic<std::uint8_t>[]>(tiles);
        for (std::size_t tile = 0; tile < tiles; ++tile) {
            ready_[tile].store(trusts ? 1 : 0, std::memory_order_relaxed);
        }
    }

    /// The number of a tile among those of all levels.
    std::size_t index_of(int level, std::size_t tile) const {
        return first_[static_cast<std::size_t>(level)] + tile;
    }

    bool is_ready(std::size_t index) const {
        return ready_[index].load(std::memory_order_acquire) != 0;
    }

    void set_ready(std::size_t index) const { ready_[index].store(1, std::memory_order_release); }

private:
    virtual void make_ready(int level, std::size_t tile) const { set_ready(index_of(level, tile)); }

    std::vector<std::size_t> first_; ///< For each level the number of its first tile.
    std::unique_ptr<std::atomic<std::uint8_t>[]> ready_;
};

} // namespace octant::visuals::terrain
