#pragma once

#include <cstdint>
#include <vector>

namespace octant::tests {

/// Rough ground of whole metres, the same for the same seed.
inline std::vector<float> rough_heights(int columns, int rows, unsigned seed = 1, int range_m = 900) {
    std::vector<float> heights_m;
    std::uint32_t state = seed;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            state = state * 1664525U + 1013904223U;
            const int noise = static_cast<int>((state >> 8U) % static_cast<unsigned>(range_m));
            heights_m.push_back(static_cast<float>(noise + 3 * column - row));
        }
    }
    return heights_m;
}

} // namespace octant::tests
