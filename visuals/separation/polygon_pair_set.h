#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::separation {

/// A set of polygons.
using PolygonBitset = std::vector<std::uint64_t>;

inline void add(PolygonBitset& bits, std::uint32_t polygon) {
    bits[polygon / 64] |= std::uint64_t{1} << (polygon % 64);
}

inline bool has(const PolygonBitset& bits, std::uint32_t polygon) {
    return ((bits[polygon / 64] >> (polygon % 64)) & 1U) != 0;
}

/// Ordered pairs of polygons: for each later one the earlier ones.
class PolygonPairSet {
public:
    explicit PolygonPairSet(std::size_t polygons) : words_((polygons + 63) / 64), bits_(polygons * words_, 0) {}

    PolygonBitset none() const { return PolygonBitset(words_, 0); }

    void add(std::uint32_t earlier, std::uint32_t later) {
        bits_[later * words_ + earlier / 64] |= std::uint64_t{1} << (earlier % 64);
    }

    void add(const PolygonBitset& earlier, std::uint32_t later) {
        for (std::size_t i = 0; i < words_; ++i) { bits_[later * words_ + i] |= earlier[i]; }
    }

    /// Calls `take(earlier)` for each polygon of `earlier` that is no pair with the later one.
    template <typename Take>
    void for_each_missing(const PolygonBitset& earlier, std::uint32_t later, Take take) const {
        for (std::size_t i = 0; i < words_; ++i) {
            std::uint64_t left = earlier[i] & ~bits_[later * words_ + i];
            for (; left != 0; left &= left - 1) {
                take(static_cast<std::uint32_t>(i * 64 + static_cast<std::size_t>(std::countr_zero(left))));
            }
        }
    }

private:
    std::size_t words_;
    std::vector<std::uint64_t> bits_;
};

} // namespace octant::visuals::separation
