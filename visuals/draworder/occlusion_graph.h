#pragma once

#include "visuals/bsp/component_search.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Polygon `first` must be painted before polygon `later`.
struct Precedence {
    std::uint32_t first = 0;
    std::uint32_t later = 0;
};

/// A painting order that was made from precedences.
struct TopologicalOrder {
    std::vector<std::uint32_t> order; ///< First painted first.
    int broken_cycles = 0;            ///< How often a polygon came before one that it should follow.
};

/// Sorts 0 to count - 1 topologically: an order that keeps all precedences (each between two of these numbers,
/// asserted), with the lowest number first wherever there is a choice. In a cycle the polygon that waits for the fewest
/// others goes ahead, the lowest number among equals; each such step counts as a broken cycle.
TopologicalOrder topological_order(std::size_t count, std::span<const Precedence> precedences);

/// The number of bits that are set in both of two rows of equal length. It adds up bytes of eight bits each (H. S.
/// Warren, "Hacker's Delight", 2003, section 5-1), because without a processor's own instruction std::popcount is a
/// function call for every word.
inline std::size_t count_common_bits(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b) {
    constexpr std::uint64_t pairs = 0x5555555555555555;
    constexpr std::uint64_t nibbles = 0x3333333333333333;
    constexpr std::uint64_t bytes = 0x0f0f0f0f0f0f0f0f;
    constexpr std::size_t max_words = 31; // A byte of `sums` can count 31 words of at most 8 bits.
    std::size_t count = 0;
    for (std::size_t word = 0; word < a.size();) {
        std::uint64_t sums = 0;
        const std::size_t end = a.size() - word > max_words ? word + max_words : a.size();
        for (; word < end; ++word) {
            std::uint64_t bits = a[word] & b[word];
            bits -= (bits >> 1) & pairs;
            bits = (bits & nibbles) + ((bits >> 2) & nibbles);
            sums += (bits + (bits >> 4)) & bytes;
        }
        constexpr std::uint64_t every_other = 0x00ff00ff00ff00ff;
        sums = (sums & every_other) + ((sums >> 8) & every_other);
        count += static_cast<std::size_t>((sums * 0x0001000100010001) >> 48);
    }
    return count;
}

/// A set of polygon numbers, one bit each.
class PolygonSet {
public:
    explicit PolygonSet(std::size_t count) : words_((count + 63) / 64, 0) {}

    bool has(std::size_t polygon) const { return ((words_[polygon / 64] >> (polygon % 64)) & 1U) != 0; }

    void add(std::size_t polygon) { words_[polygon / 64] |= std::uint64_t{1} << (polygon % 64); }

    /// Adds all polygons of another set of the same size.
    void add(const PolygonSet& other) {
        for (std::size_t i = 0; i < words_.size(); ++i) { words_[i] |= other.words_[i]; }
    }

    void remove(std::size_t polygon) { words_[polygon / 64] &= ~(std::uint64_t{1} << (polygon % 64)); }

    /// Removes all polygons of another set of the same size.
    void remove(const PolygonSet& other) {
        for (std::size_t i = 0; i < words_.size(); ++i) { words_[i] &= ~other.words_[i]; }
    }

    std::span<const std::uint64_t> words() const { return words_; }

private:
    std::vector<std::uint64_t> words_;
};

/// Which polygons hide parts of which others for the eyes of some region, as a square matrix of bits. Row a holds the
/// polygons that hide part of a; they must be painted after it.
class OcclusionGraph {
public:
    explicit OcclusionGraph(std::size_t count) : count_(count), stride_((count + 63) / 64), bits_(count * stride_, 0) {}

    std::size_t count() const { return count_; }

    /// Whether b hides part of a.
    bool occludes(std::size_t b, std::size_t a) const { return ((bits_[a * stride_ + b / 64] >> (b % 64)) & 1U) != 0; }

    void add(std::size_t b, std::size_t a) { bits_[a * stride_ + b / 64] |= std::uint64_t{1} << (b % 64); }

    void remove(std::size_t b, std::size_t a) { bits_[a * stride_ + b / 64] &= ~(std::uint64_t{1} << (b % 64)); }

    /// The polygons that hide part of a, one bit each.
    std::span<const std::uint64_t> row(std::size_t a) const { return std::span(bits_).subspan(a * stride_, stride_); }

    std::span<std::uint64_t> row(std::size_t a) { return std::span(bits_).subspan(a * stride_, stride_); }

    /// Adds a polygon with the same edges as another one: the second piece of a split polygon.
    void add_sibling(std::size_t polygon);

    /// All edges between polygons of a set, as precedences.
    std::vector<Precedence> precedences(const PolygonSet& among) const;

private:
    std::size_t count_ = 0;
    std::size_t stride_ = 0;
    std::vector<std::uint64_t> bits_;
};

/// Calls `visit` with the index of each bit that is set, lowest first.
template <typename Visit>
void for_each_bit(std::span<const std::uint64_t> words, Visit visit) {
    for (std::size_t word = 0; word < words.size(); ++word) {
        for (std::uint64_t left = words[word]; left != 0; left &= left - 1) {
            visit(word * 64 + static_cast<std::size_t>(std::countr_zero(left)));
        }
    }
}

/// The cyclic part of an occlusion graph: its strongly connected components of two or more polygons, and the edges
/// within them.
struct CyclicPart {
    std::vector<std::uint32_t> polygons; ///< The polygons of all components, ascending.
    /// The polygons of each component, ascending.
    std::vector<std::vector<std::uint32_t>> components;
    OcclusionGraph inner;  ///< The edges within components.
    std::size_t edges = 0; ///< The number of these edges.
};

/// The cyclic part of the polygons `among` and the edges between them.
CyclicPart cyclic_part_of(const OcclusionGraph& graph, std::span<const std::uint32_t> among);

/// The cyclic part among all polygons.
CyclicPart cyclic_part_of(const OcclusionGraph& graph);

/// A cycle with the fewest polygons: each is hidden by the next, and the last by the first. Empty when there is no
/// cycle. The search starts from the polygons `among`.
std::vector<std::uint32_t> shortest_cycle(const OcclusionGraph& graph, std::span<const std::uint32_t> among);

/// Counts the edges within strongly connected components, for many variants of one graph in turn. Reuses its memory.
class CyclicEdgeCounter {
public:
    /// The number of such edges in `graph` restricted to the polygons `among`, without edges into or out of `removed`,
    /// and without those by which a polygon of `occluders` hides one of `occluded`.
    std::size_t count(const OcclusionGraph& graph, std::span<const std::uint32_t> among, const PolygonSet& occluders,
        const PolygonSet& occluded, const PolygonSet& removed);

private:
    bsp::ComponentSearch search_;
    std::vector<std::uint64_t> allowed_;
    std::vector<std::uint64_t> members_;
    std::vector<std::uint64_t> row_;
};

} // namespace octant::visuals::draworder
