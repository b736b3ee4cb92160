// Topological sorting after A. B. Kahn, "Topological sorting of large networks", 1962, with a priority queue so that
// the result is unique. The 1989 paper does not say how a sequence is made from its pairs (step 5).
#include "visuals/draworder/precedence.h"

#include <cassert>
#include <functional>
#include <queue>

namespace octant::visuals::draworder {

namespace {

constexpr std::uint32_t nobody = ~std::uint32_t{0};

/// One run of the sorting.
class Sequencer {
public:
    Sequencer(std::size_t count, std::span<const Precedence> precedences)
        : later_(count), waits_for_(count, 0), painted_(count, false) {
        for (const Precedence& pair : precedences) {
            assert(pair.first < count && pair.later < count && pair.first != pair.later);
            later_[pair.first].push_back(pair.later);
            ++waits_for_[pair.later];
        }
        for (std::uint32_t polygon = 0; polygon < count; ++polygon) {
            if (waits_for_[polygon] == 0) { ready_.push(polygon); }
        }
    }

    TopologicalOrder sequence() {
        TopologicalOrder out;
        while (out.order.size() < later_.size()) {
            std::uint32_t next = 0;
            if (ready_.empty()) {
                next = min_waiting();
                ++out.broken_cycles;
            } else {
                next = ready_.top();
                ready_.pop();
            }
            paint(next);
            out.order.push_back(next);
        }
        return out;
    }

private:
    /// Paints a polygon and releases those that waited for it.
    void paint(std::uint32_t polygon) {
        painted_[polygon] = true;
        for (const std::uint32_t later : later_[polygon]) {
            --waits_for_[later];
            if (waits_for_[later] == 0 && !painted_[later]) { ready_.push(later); }
        }
    }

    /// The unpainted polygon that waits for the fewest others.
    std::uint32_t min_waiting() const {
        std::uint32_t best = nobody;
        for (std::uint32_t polygon = 0; polygon < later_.size(); ++polygon) {
            const bool better = best == nobody || waits_for_[polygon] < waits_for_[best];
            if (!painted_[polygon] && better) { best = polygon; }
        }
        return best;
    }

    std::vector<std::vector<std::uint32_t>> later_;
    std::vector<std::uint32_t> waits_for_;
    std::vector<bool> painted_;
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> ready_;
};

} // namespace

TopologicalOrder topological_order(std::size_t count, std::span<const Precedence> precedences) {
    return Sequencer(count, precedences).sequence();
}

} // namespace octant::visuals::draworder
