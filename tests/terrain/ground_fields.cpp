#include "ground_fields.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::terrain {

models::HeightField rough_field(int columns, int rows, unsigned seed, int range_m) {
    std::vector<float> heights_m;
    std::uint32_t state = seed;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            state = state * 1664525U + 1013904223U;
            const int noise = static_cast<int>((state >> 8U) % static_cast<unsigned>(range_m));
            heights_m.push_back(static_cast<float>(noise + 3 * column - row));
        }
    }
    return {columns, rows, 30.0, heights_m};
}

} // namespace octant::visuals::terrain
