#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace octant::visuals::bsp {

/// Finds the strongly connected components of graphs whose edges are rows of bits: R. Tarjan, "Depth-first search and
/// linear graph algorithms", 1972, with a stack of its own in place of recursion. Searches reuse its memory.
class ComponentSearch {
public:
    /// Searches from each of `nodes` in turn. `row_word(node, i)` holds the edges of a node to the nodes 64 i to 64 i +
    /// 63, all of them among `nodes`, which are numbers below `count`. Calls `found` with the nodes of each component
    /// after it was called with all components that edges of this one lead to.
    template <typename RowWord, typename Found>
    void search(std::size_t count, std::span<const std::uint32_t> nodes, const RowWord& row_word, const Found& found) {
        number_.resize(count);
        lowlink_.resize(count);
        next_number_ = 0;
        for (const std::uint32_t node : nodes) { number_[node] = unseen; }
        for (const std::uint32_t node : nodes) {
            if (number_[node] == unseen) { search_from(node, (count + 63) / 64, row_word, found); }
        }
    }

private:
    /// A node on the path of the search. The edges left to follow are `left` of its word, and all words behind that.
    struct Visit {
        std::uint32_t node = 0;
        std::size_t word = 0;
        std::uint64_t left = 0;
    };

    static constexpr std::uint32_t unseen = 0;
    /// The number of a node whose component is found. The largest, so that it lowers no lowlink.
    static constexpr std::uint32_t closed = std::numeric_limits<std::uint32_t>::max();

    template <typename RowWord, typename Found>
    void search_from(std::uint32_t root, std::size_t words, const RowWord& row_word, const Found& found) {
        const auto enter = [&](std::uint32_t node) {
            number_[node] = lowlink_[node] = ++next_number_;
            open_.push_back(node);
            visits_.push_back({node, 0, row_word(node, 0)});
        };
        enter(root);
        while (!visits_.empty()) {
            Visit& visit = visits_.back();
            while (visit.left == 0 && visit.word + 1 < words) { visit.left = row_word(visit.node, ++visit.word); }
            if (visit.left != 0) {
                const auto bit = static_cast<std::size_t>(std::countr_zero(visit.left));
                const auto to = static_cast<std::uint32_t>(visit.word * 64 + bit);
                visit.left &= visit.left - 1;
                if (number_[to] == unseen) {
                    enter(to);
                } else {
                    lowlink_[visit.node] = std::min(lowlink_[visit.node], number_[to]);
                }
                continue;
            }
            const std::uint32_t done = visit.node;
            visits_.pop_back();
            if (!visits_.empty()) {
                std::uint32_t& above = lowlink_[visits_.back().node];
                above = std::min(above, lowlink_[done]);
            }
            if (lowlink_[done] == number_[done]) { close(done, found); }
        }
    }

    /// Takes a component off the stack, given the first of its nodes that was reached.
    template <typename Found>
    void close(std::uint32_t first_reached, const Found& found) {
        std::size_t first = open_.size() - 1;
        while (open_[first] != first_reached) { --first; }
        const std::span<const std::uint32_t> component = std::span(open_).subspan(first);
        for (const std::uint32_t node : component) { number_[node] = closed; }
        found(component);
        open_.resize(first);
    }

    std::vector<std::uint32_t> number_; ///< By node: when the search reached it, from 1; or `unseen` or `closed`.
    std::vector<std::uint32_t> lowlink_;
    std::vector<std::uint32_t>
        open_; ///< Nodes whose component is not yet found, in the order in which they were reached.
    std::vector<Visit> visits_;
    std::uint32_t next_number_ = 0;
};

} // namespace octant::visuals::bsp
