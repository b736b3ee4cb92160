#pragma once

#include <cstddef>

namespace octant {

/// ceil(count * permille / 1000), in whole numbers so that no rounding moves it: the rank, counted from 1, of a
/// percentile by nearest rank among values sorted upwards. `permille` from 1 to 1000.
constexpr std::size_t rank_of(std::size_t count, int permille) {
    return (count * static_cast<std::size_t>(permille) + 999) / 1000;
}

} // namespace octant
