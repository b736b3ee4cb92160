// Read-ahead for mapped grounds: the kernel is asked for all tiles at once, then each is tested as it has come.
#include "visuals/terrain/bisection_prefetcher.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sys/mman.h>

namespace octant::visuals::terrain {

namespace {

/// madvise() for a range of bytes. Its result is ignored, because it is advice only.
void advise(std::span<const std::byte> bytes, int what) {
    const std::byte* const begin = bytes.data();
    const std::size_t into_page = reinterpret_cast<std::uintptr_t>(begin) % GroundLayout::page_bytes;
    ::madvise(const_cast<std::byte*>(begin - into_page), bytes.size() + into_page, what);
}

} // namespace

GroundPrefetcher::GroundPrefetcher(const GroundTiles& ground)
    : ground_(ground), requested_windows_(static_cast<std::size_t>(ground.levels())),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

GroundPrefetcher::~GroundPrefetcher() {
    thread_.request_stop();
    thread_.join();
}

void GroundPrefetcher::prefetch_around(glm::dvec2 place_m) {
    {
        const std::scoped_lock lock(mutex_);
        requested_m_ = place_m;
    }
    wake_.notify_one();
}

void GroundPrefetcher::run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        glm::dvec2 place_m;
        {
            std::unique_lock lock(mutex_);
            if (!wake_.wait(lock, stop, [this] { return requested_m_.has_value(); })) { return; }
            place_m = *requested_m_;
            requested_m_.reset();
        }
        fetch(place_m, stop);
    }
}

void GroundPrefetcher::fetch(glm::dvec2 place_m, const std::stop_token& stop) {
    for (int level = 0; level < ground_.levels(); ++level) {
        const GroundLayout::Level& at = ground_.layout().level(level);
        Window& known = requested_windows_[static_cast<std::size_t>(level)];
        const Window window = window_around(at, place_m);
        std::vector<std::size_t> tiles;
        for (int row = window.south; row < window.north; ++row) {
            for (int column = window.west; column < window.east; ++column) {
                if (column >= known.west && column < known.east && row >= known.south && row < known.north) {
                    continue;
                }
                tiles.push_back(static_cast<std::size_t>(row) * static_cast<std::size_t>(at.tiles_across) +
                                static_cast<std::size_t>(column));
            }
        }
        for (const std::size_t tile : tiles) { advise(ground_.tile(level, tile), MADV_WILLNEED); }
        for (const std::size_t tile : tiles) {
            if (stop.stop_requested()) { return; }
            advise(ground_.tile(level, tile), MADV_POPULATE_READ); // before the validator, which makes others wait
            ground_.validator().ensure_valid(level, tile);
        }
        known = window;
    }
}

/// The tiles of a level around a place.
GroundPrefetcher::Window GroundPrefetcher::window_around(const GroundLayout::Level& at, glm::dvec2 place_m) const {
    const double node_m = at.edge * ground_.spacing_m();
    const glm::dvec2 half_m = ground_.half_extent_m();
    const auto tile_of = [&at](double node, int tiles) {
        const double tile = std::floor(node / (1 << at.tile_shift));
        return static_cast<int>(std::clamp(tile, -1.0, static_cast<double>(tiles)));
    };
    const double column = (place_m.x + half_m.x) / node_m;
    const double row = (place_m.y + half_m.y) / node_m;
    return {std::max(0, tile_of(column - reach_nodes, at.tiles_across)),
        std::min(at.tiles_across, tile_of(column + reach_nodes, at.tiles_across) + 1),
        std::max(0, tile_of(row - reach_nodes, at.tiles_up)),
        std::min(at.tiles_up, tile_of(row + reach_nodes, at.tiles_up) + 1)};
}

} // namespace octant::visuals::terrain
