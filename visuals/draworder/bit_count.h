#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace octant::visuals::draworder {

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

} // namespace octant::visuals::draworder
