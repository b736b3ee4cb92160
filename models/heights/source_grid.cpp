#include "models/heights/source_grid.h"

#include "models/heights/gdal_functions.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace octant::models::heights {

namespace {

constexpr double step_tolerance = 1e-6;
constexpr double grid_tolerance = 0.01; ///< of a cell: how far off the lattice a file may lie
constexpr double turn_deg = 360.0;

bool same_system(SpatialReferenceHandle a, SpatialReferenceHandle b) {
    return a == nullptr || b == nullptr ? a == b : OSRIsSame(a, b) != 0;
}

bool is_whole(double x) { return std::abs(x - std::round(x)) <= grid_tolerance; }

} // namespace

SourceGrid::SourceGrid(SourcePiece first)
    : map_(first.raster.map), columns_(first.raster.columns), rows_(first.raster.rows),
      in_degrees_(first.raster.system && OSRIsGeographic(first.raster.system.get()) != 0) {
    pieces_.push_back(std::move(first));
}

bool SourceGrid::take(SourcePiece& piece) {
    const std::optional<GridTransform>& other = piece.raster.map;
    if (!map_ || !other || !map_->is_upright() || !other->is_upright() ||
        !same_system(piece.raster.system.get(), system())) {
        return false;
    }
    const bool same_step = std::abs(other->x_column / map_->x_column - 1.0) <= step_tolerance &&
                           std::abs(other->y_row / map_->y_row - 1.0) <= step_tolerance;
    double east = other->x0 - map_->x0;
    if (in_degrees_) { east = std::remainder(east, turn_deg); }
    const double column = east / map_->x_column;
    const double row = (other->y0 - map_->y0) / map_->y_row;
    if (!same_step || !is_whole(column) || !is_whole(row) ||
        std::max(std::abs(column), std::abs(row)) > largest_samples) {
        return false;
    }
    piece.column = static_cast<int>(std::lround(column));
    piece.row = static_cast<int>(std::lround(row));
    const int west = std::min(piece.column, 0);
    const int south = std::min(piece.row, 0);
    columns_ = std::max(columns_, piece.column + piece.raster.columns) - west;
    rows_ = std::max(rows_, piece.row + piece.raster.rows) - south;
    pieces_.push_back(std::move(piece));
    for (SourcePiece& own : pieces_) {
        own.column -= west;
        own.row -= south;
    }
    const glm::dvec2 corner = map_->at(west, south);
    map_->x0 = corner.x;
    map_->y0 = corner.y;
    return true;
}

bool SourceGrid::has_integer_metres() const {
    return std::ranges::all_of(pieces_, [](const SourcePiece& piece) { return piece.raster.has_integer_metres; });
}

bool SourceGrid::set_target_frame(SpatialReferenceHandle frame) {
    from_frame_.reset();
    to_frame_.reset();
    if (frame == nullptr) { return true; }
    if (system() == nullptr) { return false; }
    from_frame_ = between(frame, system());
    to_frame_ = between(system(), frame);
    return from_frame_ && to_frame_;
}

void SourceGrid::grid_from_frame(std::span<double> x, std::span<double> y) const {
    transform_points(from_frame_, x, y);
    const GridTransform grid = map_->inverse();
    const double middle = map_->at(0.5 * columns_, 0.5 * rows_).x;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double east = in_degrees_ ? middle + std::remainder(x[i] - middle, turn_deg) : x[i];
        const glm::dvec2 at = grid.at(east, y[i]);
        x[i] = at.x;
        y[i] = at.y;
    }
}

void SourceGrid::frame_from_grid(std::span<double> column, std::span<double> row) const {
    for (std::size_t i = 0; i < column.size(); ++i) {
        const glm::dvec2 at = map_->at(column[i], row[i]);
        column[i] = at.x;
        row[i] = at.y;
    }
    transform_points(to_frame_, column, row);
}

template <typename Height, typename ReadPiece>
void SourceGrid::read_pieces(
    const GridWindow& window, std::span<Height> heights, Height no_height, const ReadPiece& read_piece) const {
    const auto width = static_cast<std::size_t>(window.columns);
    assert(heights.size() == width * static_cast<std::size_t>(window.rows));
    const auto covers = [&window](const SourcePiece& piece) {
        return piece.column <= window.first_column && piece.row <= window.first_row &&
               piece.column + piece.raster.columns >= window.first_column + window.columns &&
               piece.row + piece.raster.rows >= window.first_row + window.rows;
    };
    if (pieces_.size() == 1 && covers(pieces_.front())) {
        read_piece(pieces_.front(), window, heights);
        return;
    }
    std::fill(heights.begin(), heights.end(), no_height);
    std::vector<Height> own;
    for (const SourcePiece& piece : pieces_) {
        const int west = std::max(window.first_column, piece.column);
        const int east = std::min(window.first_column + window.columns, piece.column + piece.raster.columns);
        const int south = std::max(window.first_row, piece.row);
        const int north = std::min(window.first_row + window.rows, piece.row + piece.raster.rows);
        if (west >= east || south >= north) { continue; }
        const auto own_width = static_cast<std::size_t>(east - west);
        own.resize(own_width * static_cast<std::size_t>(north - south));
        const GridWindow part{west - piece.column, east - west, south - piece.row, north - south};
        read_piece(piece, part, std::span<Height>(own));
        for (int row = south; row < north; ++row) {
            const Height* const from = &own[static_cast<std::size_t>(row - south) * own_width];
            Height* const to = &heights[static_cast<std::size_t>(row - window.first_row) * width +
                                        static_cast<std::size_t>(west - window.first_column)];
            for (std::size_t x = 0; x < own_width; ++x) {
                const bool free = to[x] == no_height || to[x] != to[x];
                to[x] = free ? from[x] : to[x];
            }
        }
    }
}

void SourceGrid::read(const GridWindow& window, std::span<float> heights_m, const GdalSession& gdal) const {
    read_pieces(window, heights_m, std::numeric_limits<float>::quiet_NaN(),
        [&gdal](const SourcePiece& piece, const GridWindow& part, std::span<float> heights) {
            read_heights(piece.file, piece.raster, part, heights, gdal);
        });
}

void SourceGrid::read(const GridWindow& window, std::span<std::int16_t> heights_m, const GdalSession& gdal) const {
    read_pieces(window, heights_m, void_height_m,
        [&gdal](const SourcePiece& piece, const GridWindow& part, std::span<std::int16_t> heights) {
            read_integer_metres(piece.file, piece.raster, part, heights, gdal);
        });
}

} // namespace octant::models::heights
