#include "models/heights/source_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace octant::models::heights {

namespace {

constexpr std::int64_t max_places = 250000; ///< of samples, and as many of middles

/// The middle of the lattice, in its frame's units.
glm::dvec2 middle_of(const TargetGrid& lattice) {
    return {lattice.west + 0.5 * (lattice.columns - 1) * lattice.step,
        lattice.south + 0.5 * (lattice.rows - 1) * lattice.step};
}

/// Takes in the differences between a ground and a row of a grid's places.
class Differences {
public:
    Differences(const SourceGrid& grid, const TargetGrid& lattice, const GroundAt& ground)
        : grid_(grid), lattice_(lattice), ground_(ground), middle_(middle_of(lattice)) {}

    /// `off` from whole columns and rows; `heights_m` of the places, NaN for those without data.
    void add_row(int row, double off, const std::vector<float>& heights_m) {
        x_.clear();
        y_.clear();
        for (std::size_t column = 0; column < heights_m.size(); ++column) {
            x_.push_back(static_cast<double>(column) + off);
            y_.push_back(row + off);
        }
        grid_.frame_from_grid(x_, y_);
        for (std::size_t i = 0; i < heights_m.size(); ++i) {
            if (std::isnan(heights_m[i]) || std::isnan(x_[i])) { continue; }
            const glm::dvec2 place_m = (glm::dvec2(x_[i], y_[i]) - middle_) * lattice_.unit_m;
            if (const auto height_m = ground_(place_m.x, place_m.y)) {
                const double off_m = std::abs(*height_m - static_cast<double>(heights_m[i]));
                ++found.places;
                squares_ += off_m * off_m;
                found.worst_m = std::max(found.worst_m, off_m);
            }
        }
    }

    double squares() const { return squares_; }

    HeightDeviation found; ///< its root mean square is left open

private:
    const SourceGrid& grid_;
    const TargetGrid& lattice_;
    const GroundAt& ground_;
    glm::dvec2 middle_;
    double squares_ = 0.0;
    std::vector<double> x_;
    std::vector<double> y_;
};

} // namespace

std::optional<double> source_height_m(
    const std::vector<SourceGrid>& grids, const TargetGrid& lattice, double x_m, double y_m, const GdalSession& gdal) {
    for (const SourceGrid& grid : grids) {
        glm::dvec2 at = middle_of(lattice) + glm::dvec2(x_m, y_m) / lattice.unit_m;
        grid.grid_from_frame({&at.x, 1}, {&at.y, 1});
        constexpr double rim = 1e-6;
        if (!(at.x >= -rim && at.y >= -rim && at.x <= grid.columns() - 1 + rim && at.y <= grid.rows() - 1 + rim)) {
            continue;
        }
        const int column = std::clamp(static_cast<int>(at.x), 0, std::max(grid.columns() - 2, 0));
        const int row = std::clamp(static_cast<int>(at.y), 0, std::max(grid.rows() - 2, 0));
        const int columns = std::min(2, grid.columns());
        const int rows = std::min(2, grid.rows());
        std::array<float, 4> corners_m{};
        grid.read(
            {column, columns, row, rows}, std::span(corners_m).first(static_cast<std::size_t>(columns * rows)), gdal);
        double sum_m = 0.0;
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < columns; ++i) {
                const double across = 1.0 - std::abs(at.x - column - i);
                const double along = 1.0 - std::abs(at.y - row - j);
                const double weight = (columns == 1 ? 1.0 : across) * (rows == 1 ? 1.0 : along);
                if (std::abs(weight) > rim) {
                    sum_m += weight * static_cast<double>(corners_m[static_cast<std::size_t>(j * columns + i)]);
                }
            }
        }
        if (!std::isnan(sum_m)) { return sum_m; }
    }
    return std::nullopt;
}

HeightDeviation deviation_from_source(
    const std::vector<SourceGrid>& grids, const TargetGrid& lattice, const GroundAt& ground, const GdalSession& gdal) {
    std::int64_t samples = 0;
    for (const SourceGrid& grid : grids) { samples += std::int64_t{grid.columns()} * grid.rows(); }
    const auto between = static_cast<int>(samples / max_places + 1);
    HeightDeviation whole;
    double squares = 0.0;
    for (const SourceGrid& grid : grids) {
        Differences differences(grid, lattice, ground);
        std::vector<float> two_rows(2 * static_cast<std::size_t>(grid.columns()));
        const auto width = static_cast<std::size_t>(grid.columns());
        for (int row = between / 2; row + 1 < grid.rows(); row += between) {
            grid.read({0, grid.columns(), row, 2}, two_rows, gdal);
            differences.add_row(row, 0.0, {two_rows.begin(), two_rows.begin() + grid.columns()});
            std::vector<float> middles;
            for (std::size_t x = 0; x + 1 < width; ++x) {
                middles.push_back(
                    0.25F * (two_rows[x] + two_rows[x + 1] + two_rows[width + x] + two_rows[width + x + 1]));
            }
            differences.add_row(row, 0.5, middles);
        }
        whole.places += differences.found.places;
        whole.worst_m = std::max(whole.worst_m, differences.found.worst_m);
        squares += differences.squares();
    }
    whole.rms_m = whole.places > 0 ? std::sqrt(squares / static_cast<double>(whole.places)) : 0.0;
    return whole;
}

} // namespace octant::models::heights
