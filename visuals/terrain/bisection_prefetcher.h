#pragma once

#include "visuals/terrain/bisection_tiles.h"

#include <glm/vec2.hpp>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace octant::visuals::terrain {

/// Reads the tiles around a point from the disk in advance, on a thread of its own, and validates them, so that drawing
/// seldom waits for either.
class GroundPrefetcher {
public:
    /// The distance up to which tiles are read on every level, in nodes.
    static constexpr int reach_nodes = 64;

    /// The ground must outlive the prefetcher.
    explicit GroundPrefetcher(const GroundTiles& ground);
    ~GroundPrefetcher();
    GroundPrefetcher(const GroundPrefetcher&) = delete;
    GroundPrefetcher& operator=(const GroundPrefetcher&) = delete;
    GroundPrefetcher(GroundPrefetcher&&) = delete;
    GroundPrefetcher& operator=(GroundPrefetcher&&) = delete;

    /// Requests the tiles around a point in world axes, inside the field or not. Returns at once; replaces an earlier
    /// request that has not begun. Tiles of the last request are not read again.
    void prefetch_around(glm::dvec2 place_m);

private:
    /// A rectangle of tiles of a level; east and north are one past the last.
    struct Window {
        int west = 0;
        int east = 0;
        int south = 0;
        int north = 0;
    };

    void run(const std::stop_token& stop);
    void fetch(glm::dvec2 place_m, const std::stop_token& stop);
    Window window_around(const GroundLayout::Level& at, glm::dvec2 place_m) const;

    const GroundTiles& ground_;
    std::vector<Window> requested_windows_; ///< For each level the tiles of the last request.
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::optional<glm::dvec2> requested_m_;
    std::jthread thread_;
};

} // namespace octant::visuals::terrain
