// Fills voids of fields that are too large to be smoothed in one piece: coarse first, then tile by
// tile with a margin.
#include "visuals/groundfile/integer_voids.h"

#include "models/heights/height_voids.h"

#include <algorithm>
#include <cmath>

namespace octant::visuals::groundfile {

namespace {

/// The most samples that are filled in one piece.
constexpr std::size_t max_samples_at_once = std::size_t{1} << 22U;
constexpr int rectangle_edge = 1024;
constexpr int margin = 32; ///< Samples around a piece that take part in its smoothing.

struct Field {
    std::span<std::int16_t> numbers;
    int columns;
    int rows;

    std::int16_t& at(int column, int row) const {
        return numbers
            [static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
             static_cast<std::size_t>(column)];
    }
};

float height_of(std::int16_t number) {
    return number == void_value ? std::numeric_limits<float>::quiet_NaN()
                                 : static_cast<float>(number);
}

/// The mean of the known samples of a block; NaN when there are none.
float block_mean(const Field& field, int column, int row, int edge) {
    double sum = 0.0;
    int known = 0;
    for (int y = row; y < std::min(row + edge, field.rows); ++y) {
        for (int x = column; x < std::min(column + edge, field.columns); ++x) {
            const std::int16_t number = field.at(x, y);
            sum += number == void_value ? 0.0 : number;
            known += number == void_value ? 0 : 1;
        }
    }
    return known == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(sum / known);
}

models::heights::HeightGrid block_means(const Field& field, int edge) {
    models::heights::HeightGrid means;
    means.columns = (field.columns + edge - 1) / edge;
    means.rows = (field.rows + edge - 1) / edge;
    for (int row = 0; row < field.rows; row += edge) {
        for (int column = 0; column < field.columns; column += edge) {
            means.heights_m.push_back(block_mean(field, column, row, edge));
        }
    }
    return means;
}

/// A rectangle of samples; east and north are one past the last.
struct SampleRectangle {
    int west;
    int east;
    int south;
    int north;
};

bool has_voids(const Field& field, const SampleRectangle& piece) {
    for (int row = piece.south; row < piece.north; ++row) {
        const std::int16_t* const start = &field.at(0, row);
        if (std::find(start + piece.west, start + piece.east, void_value) != start + piece.east) {
            return true;
        }
    }
    return false;
}

/// Writes the heights of a grid into the voids of a piece. `of` is the rectangle that the grid
/// covers.
void write_filled(
    const Field& field, const SampleRectangle& piece, const models::heights::HeightGrid& grid, SampleRectangle of) {
    for (int row = piece.south; row < piece.north; ++row) {
        for (int column = piece.west; column < piece.east; ++column) {
            std::int16_t& number = field.at(column, row);
            if (number == void_value) {
                number = static_cast<std::int16_t>(
                    std::lround(grid.at(column - of.west, row - of.south)));
            }
        }
    }
}

/// Fills the voids of one piece, starting from the coarse field.
void fill_rectangle(
    const Field& field, const SampleRectangle& piece, const models::heights::HeightGrid& coarse, int edge) {
    const SampleRectangle wide{
        std::max(0, piece.west - margin),
        std::min(field.columns, piece.east + margin),
        std::max(0, piece.south - margin),
        std::min(field.rows, piece.north + margin)};
    models::heights::HeightGrid grid;
    grid.columns = wide.east - wide.west;
    grid.rows = wide.north - wide.south;
    for (int row = wide.south; row < wide.north; ++row) {
        for (int column = wide.west; column < wide.east; ++column) {
            grid.heights_m.push_back(height_of(field.at(column, row)));
        }
    }
    models::heights::fill_voids_from(grid, [&](int column, int row) {
        return models::heights::interpolated(
            coarse, (wide.west + column + 0.5) / edge - 0.5, (wide.south + row + 0.5) / edge - 0.5);
    });
    write_filled(field, piece, grid, wide);
}

} // namespace

void fill_integer_voids(std::span<std::int16_t> numbers, int columns, int rows) {
    const Field field{numbers, columns, rows};
    int edge = 1;
    while (numbers.size() > max_samples_at_once * static_cast<std::size_t>(edge * edge)) {
        edge *= 2;
    }
    models::heights::HeightGrid coarse = block_means(field, edge);
    models::heights::fill_voids(coarse);
    if (edge == 1) {
        const SampleRectangle all{0, columns, 0, rows};
        write_filled(field, all, coarse, all);
        return;
    }
    for (int south = 0; south < rows; south += rectangle_edge) {
        for (int west = 0; west < columns; west += rectangle_edge) {
            const SampleRectangle piece{
                west,
                std::min(west + rectangle_edge, columns),
                south,
                std::min(south + rectangle_edge, rows)};
            if (has_voids(field, piece)) {
                fill_rectangle(field, piece, coarse, edge);
            }
        }
    }
}

} // namespace octant::visuals::groundfile
