#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace octant::visuals::terrain {

/// A field's heights as whole numbers, row after row from the south; what a ground is built from. The ground stores
/// number * multiplier + addend.
struct StoredHeights {
    std::span<const std::int16_t> numbers;
    int columns = 0;
    int rows = 0;
    int multiplier = 1;
    int addend = 0;
    double number_unit_m = 1.0; ///< The height difference of two successive numbers.
    int lowest = -32768;        ///< The limits of padded_number.
    int highest = 32767;

    std::int16_t number(int column, int row) const {
        return numbers[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(column)];
    }

    /// The number at a place of the padded square. Beyond the last column and row the field goes on as its reflection
    /// in the point on its border, so that slopes do not bend there.
    std::int16_t padded_number(int column, int row) const {
        const int last_column = std::min(column, columns - 1);
        const int last_row = std::min(row, rows - 1);
        if (column == last_column && row == last_row) { return number(column, row); }
        const int west = std::max(2 * last_column - column, 0);
        const int south = std::max(2 * last_row - row, 0);
        const auto reflected = [&](int at_row) { return 2 * number(last_column, at_row) - number(west, at_row); };
        const int value = 2 * reflected(last_row) - reflected(south);
        return static_cast<std::int16_t>(std::clamp(value, lowest, highest));
    }

    std::int16_t stored(std::int16_t number) const { return static_cast<std::int16_t>(number * multiplier + addend); }
};

} // namespace octant::visuals::terrain
