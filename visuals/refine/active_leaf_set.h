#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::refine {

/// A set of numbers below a bound that quickly finds the largest member not above a given number (a predecessor query).
/// It is a bitmap with summary levels: one bit for each number, above every 64 of these one bit that says whether any
/// of them is set, and so on up to a single word. It is small enough to stay in the processor's cache.
///
/// SelectiveRefiner keeps the first leaf of each active node in it. The active nodes partition the leaves into runs of
/// consecutive numbers, so the active ancestor of a leaf is the node whose run begins last at or before it. This is the
/// paper's ActiveAncestor without a climb from parent to parent.
class ActiveLeafSet {
public:
    /// Empties the set. From now on numbers below `bound` may be added; there are at most six levels.
    void assign(std::size_t bound) {
        std::size_t words = 0;
        levels_ = 0;
        do {
            bound = bound / word_bits + 1;
            begins_[levels_] = words;
            ++levels_;
            words += bound;
        } while (bound > 1);
        words_.assign(words, 0);
    }

    bool has(std::uint32_t number) const { return (words_[number / word_bits] >> (number % word_bits) & 1U) != 0; }

    void add(std::uint32_t number) {
        for (std::size_t level = 0; level < levels_; ++level) {
            std::uint64_t& word = words_[begins_[level] + number / word_bits];
            const bool was_empty = word == 0;
            word |= std::uint64_t{1} << number % word_bits;
            if (!was_empty) { return; }
            number /= word_bits;
        }
    }

    void remove(std::uint32_t number) {
        for (std::size_t level = 0; level < levels_; ++level) {
            std::uint64_t& word = words_[begins_[level] + number / word_bits];
            word &= ~(std::uint64_t{1} << number % word_bits);
            if (word != 0) { return; }
            number /= word_bits;
        }
    }

    /// The largest member that is not above `number`. 0 must be a member, so that there always is one.
    std::uint32_t last_up_to(std::uint32_t number) const {
        std::uint64_t word = bits_up_to(words_[number / word_bits], number);
        std::size_t level = 0;
        while (word == 0) {
            number = number / word_bits - 1;
            ++level;
            word = bits_up_to(words_[begins_[level] + number / word_bits], number);
        }
        number = last_in(word, number / word_bits);
        while (level > 0) {
            --level;
            number = last_in(words_[begins_[level] + number], number);
        }
        return number;
    }

    std::size_t bytes() const { return words_.capacity() * sizeof(std::uint64_t); }

private:
    static constexpr std::uint32_t word_bits = 64;

    /// The bits of a word up to and including that of `number`.
    static std::uint64_t bits_up_to(std::uint64_t word, std::uint32_t number) {
        return word & ~std::uint64_t{0} >> (word_bits - 1 - number % word_bits);
    }

    /// The number that the highest set bit of the word with index `at` stands for.
    static std::uint32_t last_in(std::uint64_t word, std::uint32_t at) {
        return word_bits * at + word_bits - 1 - static_cast<std::uint32_t>(std::countl_zero(word));
    }

    /// All levels one after the other, the bits of the numbers themselves first.
    std::vector<std::uint64_t> words_;
    std::array<std::size_t, 6> begins_{}; ///< The index in words_ at which each level begins.
    std::size_t levels_ = 0;
};

} // namespace octant::visuals::refine
