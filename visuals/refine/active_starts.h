#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::refine {

/// A set of numbers below a bound that tells fast which one lies next before any number: one bit
/// each, and above every 64 of them one that says whether any is set, and so on. Small enough to
/// stay in the processor's nearest memory.
///
/// SelectiveRefiner keeps the first leaf of each active node in it. Active nodes part the leaves
/// among them, those of each follow one another: the active node above a leaf is the one that
/// begins last before it, and no climb from parent to parent is needed.
class ActiveStarts {
public:
    /// Empties the set; numbers below `bound` fit from now on.
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

    bool has(std::uint32_t number) const {
        return (words_[number / word_bits] >> (number % word_bits) & 1U) != 0;
    }

    void add(std::uint32_t number) {
        for (std::size_t level = 0; level < levels_; ++level) {
            std::uint64_t& word = words_[begins_[level] + number / word_bits];
            const bool was_empty = word == 0;
            word |= std::uint64_t{1} << number % word_bits;
            if (!was_empty) {
                return;
            }
            number /= word_bits;
        }
    }

    void remove(std::uint32_t number) {
        for (std::size_t level = 0; level < levels_; ++level) {
            std::uint64_t& word = words_[begins_[level] + number / word_bits];
            word &= ~(std::uint64_t{1} << number % word_bits);
            if (word != 0) {
                return;
            }
            number /= word_bits;
        }
    }

    /// The largest member that is not above a number; 0 must be a member.
    std::uint32_t at_or_before(std::uint32_t number) const {
        std::uint64_t word = upto(words_[number / word_bits], number);
        std::size_t level = 0;
        while (word == 0) {
            number = number / word_bits - 1;
            ++level;
            word = upto(words_[begins_[level] + number / word_bits], number);
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

    static std::uint64_t upto(std::uint64_t word, std::uint32_t number) {
        return word & ~std::uint64_t{0} >> (word_bits - 1 - number % word_bits);
    }

    static std::uint32_t last_in(std::uint64_t word, std::uint32_t at) {
        return word_bits * at + word_bits - 1 - static_cast<std::uint32_t>(std::countl_zero(word));
    }

    std::vector<std::uint64_t> words_;    ///< the numbers' own first
    std::array<std::size_t, 6> begins_{}; ///< of each level in words_
    std::size_t levels_ = 0;
};

} // namespace octant::visuals::refine
