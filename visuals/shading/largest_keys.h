#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::shading {

/// Packs a tier (0 to 3) and a rank (at least 0, finite) into one number, so that comparing keys compares first by tier
/// and then by rank. It uses that the bits of non-negative floats sort as integers do. The lowest bit of the rank is
/// lost: neighbouring floats may count as equal.
inline std::uint32_t sort_key(std::uint32_t tier, float rank) {
    return tier << 30U | std::bit_cast<std::uint32_t>(rank) >> 1U;
}

/// Finds the `count` greatest of many keys in linear time: a histogram over the keys' top bits finds the bucket in
/// which the boundary lies, and only that bucket is partially sorted. Its memory is reused from call to call.
class LargestKeySelector {
public:
    /// Sets `chosen`, which has as many entries as `keys`, to 1 for the `count` greatest keys and to 0 for the others.
    /// Of equal keys the one with the lower index is taken first, so that the result is always the same. `count` is at
    /// most the number of keys (asserted).
    void choose(std::span<const std::uint32_t> keys, std::size_t count, std::span<std::uint8_t> chosen);

private:
    /// A bucket has the tier, the exponent and the two top bits of the rank's fraction in common.
    static constexpr unsigned bucket_shift = 20;

    std::array<std::uint32_t, std::size_t{1} << (32U - bucket_shift)> counts_{};
    /// The indices of the keys in the one bucket that is chosen only in part.
    std::vector<std::uint32_t> border_;
};

} // namespace octant::visuals::shading
