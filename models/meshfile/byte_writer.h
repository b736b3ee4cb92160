#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

namespace octant::models::meshfile {

/// Appends a number to a binary file's bytes, little endian.
template <typename T>
void append_number(std::string& bytes, T value) {
    auto own = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big) { std::ranges::reverse(own); }
    bytes.append(own.data(), own.size());
}

} // namespace octant::models::meshfile
