// Strongly connected components of occlusion graphs: R. Tarjan, "Depth-first search and linear graph algorithms", 1972,
// with a stack of its own instead of recursion and with rows of bits as adjacency. A painting order exists exactly when
// there is no component of two or more polygons; the 1989 paper does not mention cycles.
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

std::vector<Precedence> OcclusionGraph::precedences(const PolygonSet& among) const {
    std::vector<Precedence> pairs;
    for_each_bit(among.words(), [&](std::size_t a) {
        for_each_bit(row(a), [&](std::size_t b) {
            if (among.has(b)) { pairs.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)}); }
        });
    });
    return pairs;
}

namespace {

/// The number of a polygon that the search has not reached.
constexpr std::uint32_t unseen = ~std::uint32_t{0};

} // namespace

std::uint64_t CyclicEdgeCounter::row_word(std::uint32_t polygon, std::size_t word) const {
    const std::uint64_t barred = hidden_->has(polygon) ? hiding_->words()[word] : 0;
    return graph_->row(polygon)[word] & allowed_[word] & ~barred;
}

/// Takes a finished component off the stack, given its first polygon, and counts the edges within it.
void CyclicEdgeCounter::close(std::uint32_t polygon) {
    const auto first = std::ranges::find(open_, polygon);
    if (open_.end() - first > 1) {
        std::ranges::fill(members_, std::uint64_t{0});
        for (auto it = first; it != open_.end(); ++it) { members_[*it / 64] |= std::uint64_t{1} << (*it % 64); }
        for (auto it = first; it != open_.end(); ++it) {
            for (std::size_t word = 0; word < members_.size(); ++word) { row_[word] = row_word(*it, word); }
            edges_ += count_common_bits(row_, members_);
        }
    }
    for (auto it = first; it != open_.end(); ++it) { component_[*it] = next_component_; }
    open_.erase(first, open_.end());
    ++next_component_;
}

void CyclicEdgeCounter::search_from(std::uint32_t root) {
    const auto enter = [this](std::uint32_t polygon) {
        number_[polygon] = lowlink_[polygon] = next_number_++;
        open_.push_back(polygon);
        visits_.push_back({polygon, 0, row_word(polygon, 0)});
    };
    enter(root);
    while (!visits_.empty()) {
        Visit& visit = visits_.back();
        while (visit.left == 0 && visit.word + 1 < allowed_.size()) {
            visit.left = row_word(visit.polygon, ++visit.word);
        }
        if (visit.left != 0) {
            const auto bit = static_cast<std::size_t>(std::countr_zero(visit.left));
            const auto to = static_cast<std::uint32_t>(visit.word * 64 + bit);
            visit.left &= visit.left - 1;
            if (number_[to] == unseen) {
                enter(to);
            } else if (component_[to] == unseen) {
                lowlink_[visit.polygon] = std::min(lowlink_[visit.polygon], number_[to]);
            }
            continue;
        }
        const std::uint32_t done = visit.polygon;
        visits_.pop_back();
        if (!visits_.empty()) {
            std::uint32_t& above = lowlink_[visits_.back().polygon];
            above = std::min(above, lowlink_[done]);
        }
        if (lowlink_[done] == number_[done]) { close(done); }
    }
}

std::size_t CyclicEdgeCounter::count(const OcclusionGraph& graph, std::span<const std::uint32_t> among,
    const PolygonSet& occluders, const PolygonSet& occluded, const PolygonSet& removed) {
    graph_ = &graph;
    hiding_ = &occluders;
    hidden_ = &occluded;
    const std::size_t words = occluders.words().size();
    allowed_.assign(words, 0);
    members_.assign(words, 0);
    row_.assign(words, 0);
    number_.resize(graph.count());
    lowlink_.resize(graph.count());
    component_.resize(graph.count());
    next_number_ = next_component_ = 0;
    edges_ = 0;
    for (const std::uint32_t polygon : among) {
        number_[polygon] = component_[polygon] = unseen;
        if (!removed.has(polygon)) { allowed_[polygon / 64] |= std::uint64_t{1} << (polygon % 64); }
    }
    for (const std::uint32_t polygon : among) {
        if (number_[polygon] == unseen && !removed.has(polygon)) { search_from(polygon); }
    }
    return edges_;
}

CyclicPart cyclic_part_of(const OcclusionGraph& graph, std::span<const std::uint32_t> among) {
    const PolygonSet none(graph.count());
    CyclicEdgeCounter search;
    CyclicPart cycles{.polygons = {}, .components = {}, .inner = OcclusionGraph(graph.count())};
    cycles.edges = search.count(graph, among, none, none, none);
    std::vector<std::vector<std::uint32_t>> members(among.size());
    for (const std::uint32_t polygon : among) { members[search.component_of()[polygon]].push_back(polygon); }
    for (std::vector<std::uint32_t>& component : members) {
        if (component.size() < 2) { continue; }
        std::ranges::sort(component);
        PolygonSet inside(graph.count());
        for (const std::uint32_t polygon : component) { inside.add(polygon); }
        for (const std::uint32_t polygon : component) {
            const auto from = graph.row(polygon);
            const auto to = cycles.inner.row(polygon);
            for (std::size_t word = 0; word < from.size(); ++word) { to[word] = from[word] & inside.words()[word]; }
        }
        cycles.polygons.insert(cycles.polygons.end(), component.begin(), component.end());
        cycles.components.push_back(std::move(component));
    }
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
        std::vector<std::uint32_t> came_from(graph.count(), unseen);
        std::vector<std::uint32_t> reached{start};
        for (std::size_t i = 0; i < reached.size() && came_from[start] == unseen; ++i) {
            for_each_bit(graph.row(reached[i]), [&](std::size_t to) {
                if (came_from[to] == unseen) {
                    came_from[to] = reached[i];
                    reached.push_back(static_cast<std::uint32_t>(to));
                }
            });
        }
        if (came_from[start] == unseen) { continue; }
        std::vector<std::uint32_t> cycle{start};
        for (std::uint32_t at = came_from[start]; at != start; at = came_from[at]) { cycle.push_back(at); }
        std::reverse(cycle.begin() + 1, cycle.end());
        if (best.empty() || cycle.size() < best.size()) { best = std::move(cycle); }
    }
    return best;
}

} // namespace octant::visuals::draworder
