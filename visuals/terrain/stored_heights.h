#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace octant::visuals::terrain {

/// A field's heights as whole numbers, row after row from the south; what a ground is built from.
/// The ground stores number * multiplier + addend.
struct StoredHeights {
    std::span<const std::int16_t> numbers;
    int columns = 0;
    int rows = 0;
    int multiplier = 1;
    int addend = 0;
    double number_unit_m = 1.0; ///< The height difference of two successive numbers.

    std::int16_t number(int column, int row) const {
        return numbers
            [static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
             static_cast<std::size_t>(column)];
    }

    std::int16_t stored(std::int16_t number) const {
        return static_cast<std::int16_t>(number * multiplier + addend);
    }
};

} // namespace octant::visuals::terrain
