#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace octant::visuals::refine {

/// An array of numbers below 2^24 in three bytes each.
class Uint24Array {
public:
    /// Makes an array of `count` zeros.
    void assign(std::size_t count) { bytes_.assign(3 * count + 1, 0); }

    std::uint32_t operator[](std::size_t at) const {
        std::uint32_t number = 0;
        std::memcpy(&number, &bytes_[3 * at], 4);
        return number & 0xffffffU;
    }

    void set(std::size_t at, std::uint32_t number) { std::memcpy(&bytes_[3 * at], &number, 3); }

    std::size_t bytes() const { return bytes_.capacity(); }

private:
    static_assert(std::endian::native == std::endian::little);

    /// There is one more byte at the end, because numbers are read four bytes at a time.
    std::vector<std::uint8_t> bytes_;
};

} // namespace octant::visuals::refine
