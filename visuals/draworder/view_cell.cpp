// The step from a region to a smaller one. Precedences only disappear when a region shrinks, so a child tests no more
// than the cyclic edges of its parent; and an acyclic graph over a region gives, by topological sorting, one list that
// is right for all of its eyes.
#include "visuals/draworder/view_cell.h"

#include "visuals/draworder/bit_count.h"
#include "visuals/draworder/search_budget.h"

#include <cassert>
#include <fmt/format.h>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace octant::visuals::draworder {

namespace {

/// The most entries of all lists: each takes 4 bytes here and some 24 in a renderer's index buffer.
constexpr std::size_t max_entries = 8'000'000;

} // namespace

void check_entries(std::size_t entries) {
    if (entries > max_entries) {
        throw SearchGivenUp{fmt::format("the lists of its cells have more than {} entries", max_entries)};
    }
}

std::uint64_t search_units(const ViewCell& node) {
    constexpr std::uint64_t of_edge = 700;
    constexpr std::uint64_t of_polygon = 2'000;
    const std::uint64_t words = node.graph.count() * (node.graph.count() / 64 + 1);
    return of_edge * node.cycles.edges + of_polygon * node.cycles.polygons.size() + 2 * words;
}

ViewCell view_cell(OcclusionGraphBuilder& graphs, const ViewRegion& region) {
    OcclusionGraph graph = graphs.all(region);
    CyclicPart cycles = cyclic_part_of(graph);
    return {region, std::move(graph), std::move(cycles)};
}

ViewCell part_of(OcclusionGraphBuilder& graphs, const ViewCell& node, ViewRegion part, const PlaneSideSets* sides) {
    const OcclusionGraph& inner = node.cycles.inner;
    const auto& among = node.cycles.polygons;
    const OcclusionGraph unsplit_cycles = sides != nullptr ? graphs.remaining_in_front(inner, among, *sides) : inner;
    const CyclicPart tested = sides != nullptr ? cyclic_part_of(unsplit_cycles, among) : node.cycles;
    const OcclusionGraph left = graphs.surviving(part, tested.inner, tested.polygons);
    OcclusionGraph graph = node.graph;
    for (const std::uint32_t a : among) {
        const auto row = graph.row(a);
        for (std::size_t word = 0; word < row.size(); ++word) {
            const std::uint64_t off_rings = unsplit_cycles.row(a)[word] & ~tested.inner.row(a)[word];
            row[word] = (row[word] & ~inner.row(a)[word]) | off_rings | left.row(a)[word];
        }
    }
    return {std::move(part), std::move(graph), cyclic_part_of(left, tested.polygons)};
}

std::optional<PersistentCycle> cycle_at_eye(OcclusionGraphBuilder& graphs, const ViewCell& node) {
    const auto& among = node.cycles.polygons;
    const auto eye = node.region.interior_point();
    if (!eye) { throw SearchGivenUp{"a cell is too thin to hold an eye"}; }
    CyclicPart ring = cyclic_part_of(graphs.at_eye(*eye, node.cycles.inner, among), among);
    if (ring.edges == 0) { return std::nullopt; }
    return PersistentCycle{std::move(ring.components.front()), node.region, eye};
}

std::vector<std::uint32_t> list_of(const OcclusionGraphBuilder& graphs, const ViewCell& node) {
    const PolygonSet listed = graphs.listed(node.region);
    std::vector<std::uint32_t> waits_for(node.graph.count(), 0);
    for_each_bit(listed.words(),
        [&](std::size_t a) { for_each_bit(node.graph.row(a), [&](std::size_t b) { ++waits_for[b]; }); });
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
    const auto release = [&](std::size_t polygon) {
        if (waits_for[polygon] == 0 && listed.has(polygon)) { ready.push(polygon); }
    };
    for_each_bit(listed.words(), release);
    std::vector<std::uint32_t> list;
    while (!ready.empty()) {
        const std::size_t next = ready.top();
        ready.pop();
        list.push_back(static_cast<std::uint32_t>(next));
        for_each_bit(node.graph.row(next), [&](std::size_t later) {
            --waits_for[later];
            release(later);
        });
    }
    assert(list.size() == count_common_bits(listed.words(), listed.words()));
    return list;
}

std::vector<std::vector<std::uint32_t>> component_sets(const OcclusionGraphBuilder& graphs, const ViewCell& node) {
    const std::size_t count = node.graph.count();
    const PolygonSet listed = graphs.listed(node.region);
    std::vector<std::vector<std::uint32_t>> sets(count); // by their first polygons
    std::vector<std::size_t> set_of(count);
    std::iota(set_of.begin(), set_of.end(), std::size_t{0});
    for (const auto& component : node.cycles.components) {
        for (const std::uint32_t polygon : component) { set_of[polygon] = component.front(); }
    }
    for_each_bit(listed.words(),
        [&](std::size_t polygon) { sets[set_of[polygon]].push_back(static_cast<std::uint32_t>(polygon)); });
    const auto for_each_edge = [&](std::size_t set, const auto& visit) {
        for (const std::uint32_t polygon : sets[set]) {
            for_each_bit(node.graph.row(polygon), [&](std::size_t later) {
                if (listed.has(later) && set_of[later] != set) { visit(set_of[later]); }
            });
        }
    };
    std::vector<std::uint32_t> waits_for(count, 0);
    for (std::size_t set = 0; set < count; ++set) {
        for_each_edge(set, [&](std::size_t later) { ++waits_for[later]; });
    }
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
    for (std::size_t set = 0; set < count; ++set) {
        if (!sets[set].empty() && waits_for[set] == 0) { ready.push(set); }
    }
    std::vector<std::vector<std::uint32_t>> clusters;
    while (!ready.empty()) {
        const std::size_t next = ready.top();
        ready.pop();
        for_each_edge(next, [&](std::size_t later) {
            if (--waits_for[later] == 0) { ready.push(later); }
        });
        clusters.push_back(std::move(sets[next]));
    }
    return clusters;
}

} // namespace octant::visuals::draworder
