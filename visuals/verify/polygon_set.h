#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::verify {

/// A set of polygons.
class PolygonSet {
public:
    explicit PolygonSet(std::size_t polygons)
        : words_((polygons + 63) / 64, 0) {}

    void add(std::uint32_t polygon) { words_[polygon / 64] |= std::uint64_t{1} << (polygon % 64); }

    void add(const PolygonSet& others) {
        for (std::size_t i = 0; i < words_.size(); ++i) {
            words_[i] |= others.words_[i];
        }
    }

    bool has(std::uint32_t polygon) const {
        return ((words_[polygon / 64] >> (polygon % 64)) & 1U) != 0;
    }

    /// Whether all of these are among others.
    bool is_subset_of(const PolygonSet& others) const {
        for (std::size_t i = 0; i < words_.size(); ++i) {
            if ((words_[i] & ~others.words_[i]) != 0) {
                return false;
            }
        }
        return true;
    }

private:
    std::vector<std::uint64_t> words_;
};

} // namespace octant::visuals::verify
