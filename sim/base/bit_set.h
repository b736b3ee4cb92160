#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant {

/// Calls `visit` with the index of each bit that is set, lowest first.
template <typename Visit>
void for_each_bit(std::span<const std::uint64_t> words, Visit visit) {
    for (std::size_t word = 0; word < words.size(); ++word) {
        for (std::uint64_t left = words[word]; left != 0; left &= left - 1) {
            visit(word * 64 + static_cast<std::size_t>(std::countr_zero(left)));
        }
    }
}

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

/// A matrix of bits. Each row is a whole number of words; the bits after its last column are 0 unless written.
class BitMatrix {
public:
    BitMatrix() = default;

    BitMatrix(std::size_t rows, std::size_t columns) : row_words_((columns + 63) / 64), words_(rows * row_words_, 0) {}

    std::size_t row_words() const { return row_words_; }

    std::span<const std::uint64_t> row(std::size_t i) const {
        return std::span(words_).subspan(i * row_words_, row_words_);
    }

    std::span<std::uint64_t> row(std::size_t i) { return std::span(words_).subspan(i * row_words_, row_words_); }

    bool has(std::size_t row, std::size_t column) const {
        return ((words_[row * row_words_ + column / 64] >> (column % 64)) & 1U) != 0;
    }

    void add(std::size_t row, std::size_t column) {
        words_[row * row_words_ + column / 64] |= std::uint64_t{1} << (column % 64);
    }

    void remove(std::size_t row, std::size_t column) {
        words_[row * row_words_ + column / 64] &= ~(std::uint64_t{1} << (column % 64));
    }

private:
    std::size_t row_words_ = 0;
    std::vector<std::uint64_t> words_;
};

/// A set of the numbers 0 to count - 1, one bit each.
class BitSet {
public:
    explicit BitSet(std::size_t count = 0) : words_((count + 63) / 64, 0) {}

    /// Makes the set an empty one of 0 to count - 1, in the memory that it has.
    void clear(std::size_t count) { words_.assign((count + 63) / 64, 0); }

    bool has(std::size_t i) const { return ((words_[i / 64] >> (i % 64)) & 1U) != 0; }

    void add(std::size_t i) { words_[i / 64] |= std::uint64_t{1} << (i % 64); }

    /// Adds all numbers of another set of the same size.
    void add(const BitSet& other) {
        for (std::size_t i = 0; i < words_.size(); ++i) { words_[i] |= other.words_[i]; }
    }

    void remove(std::size_t i) { words_[i / 64] &= ~(std::uint64_t{1} << (i % 64)); }

    /// Removes all numbers of another set of the same size.
    void remove(const BitSet& other) {
        for (std::size_t i = 0; i < words_.size(); ++i) { words_[i] &= ~other.words_[i]; }
    }

    std::span<const std::uint64_t> words() const { return words_; }

private:
    std::vector<std::uint64_t> words_;
};

} // namespace octant
