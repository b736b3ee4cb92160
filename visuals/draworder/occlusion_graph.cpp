// A painting order exists exactly when an occlusion graph has no strongly connected component of two or more polygons;
// the 1989 paper does not mention cycles.
#include "visuals/draworder/occlusion_graph.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace octant::visuals::draworder {

// Topological sorting after A. B. Kahn, "Topological sorting of large networks", 1962, with a priority queue so that
// the result is unique. The 1989 paper does not say how a sequence is made from its pairs (step 5).

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

void OcclusionGraph::add_sibling(std::size_t polygon) {
    OcclusionGraph bigger(count_ + 1);
    for (std::size_t a = 0; a <= count_; ++a) {
        const std::size_t as = a < count_ ? a : polygon;
        std::ranges::copy(row(as), bigger.row(a).begin());
        if (occludes(polygon, as)) { bigger.add(count_, a); }
    }
    *this = std::move(bigger);
}

std::vector<Precedence> OcclusionGraph::precedences(const BitSet& among) const {
    std::vector<Precedence> pairs;
    for_each_bit(among.words(), [&](std::size_t a) {
        for_each_bit(row(a), [&](std::size_t b) {
            if (among.has(b)) { pairs.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)}); }
        });
    });
    return pairs;
}

std::size_t CyclicEdgeCounter::count(const OcclusionGraph& graph, std::span<const std::uint32_t> among,
    const BitSet& occluders, const BitSet& occluded, const BitSet& removed) {
    allowed_.clear(graph.count());
    row_.assign(allowed_.words().size(), 0);
    for (const std::uint32_t polygon : among) {
        if (!removed.has(polygon)) { allowed_.add(polygon); }
    }
    const auto row_word = [&](std::uint32_t polygon, std::size_t word) {
        const std::uint64_t without = occluded.has(polygon) ? occluders.words()[word] : 0;
        return graph.row(polygon)[word] & allowed_.words()[word] & ~without;
    };
    std::size_t edges = 0;
    search_.search(graph.count(), among, row_word, [&](std::span<const std::uint32_t> component) {
        if (component.size() < 2) { return; }
        members_.clear(graph.count());
        for (const std::uint32_t polygon : component) { members_.add(polygon); }
        for (const std::uint32_t polygon : component) {
            for (std::size_t word = 0; word < row_.size(); ++word) { row_[word] = row_word(polygon, word); }
            edges += count_common_bits(row_, members_.words());
        }
    });
    return edges;
}

CyclicPart cyclic_part_of(const OcclusionGraph& graph, std::span<const std::uint32_t> among) {
    CyclicPart cycles{.polygons = {}, .components = {}, .inner = OcclusionGraph(graph.count())};
    BitSet allowed(graph.count());
    for (const std::uint32_t polygon : among) { allowed.add(polygon); }
    const auto row_word = [&](std::uint32_t polygon, std::size_t word) {
        return graph.row(polygon)[word] & allowed.words()[word];
    };
    bsp::ComponentSearch().search(graph.count(), among, row_word, [&](std::span<const std::uint32_t> component) {
        if (component.size() < 2) { return; }
        BitSet inside(graph.count());
        for (const std::uint32_t polygon : component) { inside.add(polygon); }
        for (const std::uint32_t polygon : component) {
            const auto to = cycles.inner.row(polygon);
            for (std::size_t word = 0; word < to.size(); ++word) {
                to[word] = row_word(polygon, word) & inside.words()[word];
                cycles.edges += static_cast<std::size_t>(std::popcount(to[word]));
            }
        }
        cycles.polygons.insert(cycles.polygons.end(), component.begin(), component.end());
        std::ranges::sort(cycles.components.emplace_back(component.begin(), component.end()));
    });
    std::ranges::sort(cycles.polygons);
    return cycles;
}

CyclicPart cyclic_part_of(const OcclusionGraph& graph) {
    std::vector<std::uint32_t> all(graph.count());
    std::iota(all.begin(), all.end(), 0U);
    return cyclic_part_of(graph, all);
}

std::vector<std::uint32_t> shortest_cycle(const OcclusionGraph& graph, std::span<const std::uint32_t> among) {
    std::vector<std::uint32_t> best;
    for (const std::uint32_t start : among) {
        std::vector<std::uint32_t> came_from(graph.count(), nobody);
        std::vector<std::uint32_t> reached{start};
        for (std::size_t i = 0; i < reached.size() && came_from[start] == nobody; ++i) {
            for_each_bit(graph.row(reached[i]), [&](std::size_t to) {
                if (came_from[to] == nobody) {
                    came_from[to] = reached[i];
                    reached.push_back(static_cast<std::uint32_t>(to));
                }
            });
        }
        if (came_from[start] == nobody) { continue; }
        std::vector<std::uint32_t> cycle{start};
        for (std::uint32_t at = came_from[start]; at != start; at = came_from[at]) { cycle.push_back(at); }
        std::reverse(cycle.begin() + 1, cycle.end());
        if (best.empty() || cycle.size() < best.size()) { best = std::move(cycle); }
    }
    return best;
}

} // namespace octant::visuals::draworder
