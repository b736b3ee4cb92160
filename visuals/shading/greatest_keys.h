#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::shading {

/// A number by which polygons are sorted: first by tier (0 to 3), then by rank (at least 0; ranks
/// that differ by one step of a float may count as equal).
inline std::uint32_t key_of(std::uint32_t tier, float rank) {
    return tier << 30U | std::bit_cast<std::uint32_t>(rank) >> 1U;
}

/// Finds the greatest of many keys in linear time. Keeps its memory.
class GreatestKeys {
public:
    /// `chosen`, as many as keys: 1 for the `count` greatest ones, of equal keys those with the
    /// lower index first, else 0. `count` is at most the number of keys (asserted).
    void
    choose(std::span<const std::uint32_t> keys, std::size_t count, std::span<std::uint8_t> chosen);

private:
    static constexpr unsigned bucket_shift = 20; ///< tier, exponent, two bits of the rank

    std::array<std::uint32_t, std::size_t{1} << (32U - bucket_shift)> counts_{};
    std::vector<std::uint32_t> border_; ///< indices of the bucket that only some are chosen of
};

} // namespace octant::visuals::shading
