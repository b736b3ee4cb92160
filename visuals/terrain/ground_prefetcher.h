#pragma once

#include "visuals/terrain/ground_tiles.h"

#include <glm/vec2.hpp>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace octant::visuals::terrain {

/// Fetches from the disk, on a thread of its own, the tiles around a place before they are needed, and has the ground's
/// validator check them, so that drawing seldom waits for either.
class GroundPrefetcher {
public:
    /// On every level tiles are asked for up to this many nodes away from the place.
    static constexpr int reach_nodes = 64;

    /// The ground must outlive the prefetcher.
    explicit GroundPrefetcher(const GroundTiles& ground);
    ~GroundPrefetcher();
    GroundPrefetcher(const GroundPrefetcher&) = delete;
    GroundPrefetcher& operator=(const GroundPrefetcher&) = delete;
    GroundPrefetcher(GroundPrefetcher&&) = delete;
    GroundPrefetcher& operator=(GroundPrefetcher&&) = delete;

    /// Tells where tiles are wanted next, in world axes, within the field or not. Returns at once; an earlier place
    /// that was not dealt with yet is forgotten. Tiles that were asked for at the last place are not asked for again.
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
    std::vector<Window> requested_windows_; ///< For each level what was asked for last.
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::optional<glm::dvec2> requested_m_;
    std::jthread thread_;
};

} // namespace octant::visuals::terrain
