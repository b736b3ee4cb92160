#include "visuals/draworder/cut_pieces.h"

#include <cstddef>
#include <limits>
#include <utility>

namespace octant::visuals::draworder {

void insert_cut_pieces(std::vector<std::uint32_t>& list, std::span<const std::uint32_t> cut_from, std::uint32_t first) {
    if (cut_from.empty()) { return; }
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> latest(first + cut_from.size(), none); // that was cut off a piece
    std::vector<std::uint32_t> before(latest.size(), none);           // that was cut off the same one
    for (std::size_t i = 0; i < cut_from.size(); ++i) {
        before[first + i] = std::exchange(latest[cut_from[i]], static_cast<std::uint32_t>(first + i));
    }
    std::vector<std::uint32_t> with_pieces;
    std::vector<std::uint32_t> pending;
    for (const std::uint32_t polygon : list) {
        pending.push_back(polygon);
        while (!pending.empty()) {
            const std::uint32_t at = pending.back();
            pending.pop_back();
            with_pieces.push_back(at);
            for (const std::uint32_t next : {before[at], latest[at]}) {
                if (next != none) { pending.push_back(next); }
            }
        }
    }
    list = std::move(with_pieces);
}

} // namespace octant::visuals::draworder
