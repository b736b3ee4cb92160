#pragma once

#include "visuals/draworder/precedence.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// A set of polygon numbers, one bit each.
class PolygonSet {
public:
    explicit PolygonSet(std::size_t count) : words_((count + 63) / 64, 0) {}

    bool has(std::size_t polygon) const { return ((words_[polygon / 64] >> (polygon % 64)) & 1U) != 0; }

    void add(std::size_t polygon) { words_[polygon / 64] |= std::uint64_t{1} << (polygon % 64); }

    void remove(std::size_t polygon) { words_[polygon / 64] &= ~(std::uint64_t{1} << (polygon % 64)); }

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

} // namespace octant::visuals::draworder
