#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <ranges>

namespace octant {

/// The rank of a percentile by nearest rank among `count` sorted values, counted from 1: ceil(count * permille / 1000),
/// in integers so that it is exact. `permille` is 1 to 1000.
constexpr std::size_t rank_of(std::size_t count, int permille) {
    return (count * static_cast<std::size_t>(permille) + 999) / 1000;
}

/// The percentile of the values by nearest rank; 0 if there are none. Reorders the values.
template <std::ranges::random_access_range Values>
double nearest_rank(Values&& values, int permille) {
    if (std::ranges::empty(values)) { return 0.0; }
    const auto at = std::ranges::begin(values) + static_cast<std::ptrdiff_t>(rank_of(values.size(), permille) - 1);
    std::ranges::nth_element(values, at);
    return static_cast<double>(*at);
}

} // namespace octant
