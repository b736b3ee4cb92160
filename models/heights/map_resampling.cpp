#include "models/heights/map_resampling.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/local_frame.h"
#include "sim/base/error.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <string_view>
#include <utility>

namespace octant::models::heights {

using std::filesystem::path;

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

void SourceGrid::read(const GridWindow& window, std::span<float> heights_m, const GdalSession& gdal) const {
    const auto width = static_cast<std::size_t>(window.columns);
    assert(heights_m.size() == width * static_cast<std::size_t>(window.rows));
    const auto covers = [&window](const SourcePiece& piece) {
        return piece.column <= window.first_column && piece.row <= window.first_row &&
               piece.column + piece.raster.columns >= window.first_column + window.columns &&
               piece.row + piece.raster.rows >= window.first_row + window.rows;
    };
    if (pieces_.size() == 1 && covers(pieces_.front())) {
        read_heights(pieces_.front().file, pieces_.front().raster, window, heights_m, gdal);
        return;
    }
    std::ranges::fill(heights_m, std::numeric_limits<float>::quiet_NaN());
    std::vector<float> own;
    for (const SourcePiece& piece : pieces_) {
        const int west = std::max(window.first_column, piece.column);
        const int east = std::min(window.first_column + window.columns, piece.column + piece.raster.columns);
        const int south = std::max(window.first_row, piece.row);
        const int north = std::min(window.first_row + window.rows, piece.row + piece.raster.rows);
        if (west >= east || south >= north) { continue; }
        const auto own_width = static_cast<std::size_t>(east - west);
        own.resize(own_width * static_cast<std::size_t>(north - south));
        const GridWindow part{west - piece.column, east - west, south - piece.row, north - south};
        read_heights(piece.file, piece.raster, part, own, gdal);
        for (int row = south; row < north; ++row) {
            const float* const from = &own[static_cast<std::size_t>(row - south) * own_width];
            float* const to = &heights_m[static_cast<std::size_t>(row - window.first_row) * width +
                                         static_cast<std::size_t>(west - window.first_column)];
            for (std::size_t x = 0; x < own_width; ++x) { to[x] = std::isnan(to[x]) ? from[x] : to[x]; }
        }
    }
}

namespace {

constexpr double square_tolerance = 1e-6;
constexpr double scale_tolerance = 0.01;
constexpr double widest_m = 1.0e6;
/// Points looked at along each edge of a grid.
constexpr int edge_points = 257;
/// Up to so many samples a ground has two for each step of its finest source: half as far off.
constexpr double max_halved = 4096.0 * 4096.0;
constexpr double min_left = 0.5; ///< of a grid's bounds, in the rectangle within its edges

/// Points of a grid's edges in the frame: west, east, south, north. Empty where one cannot be told.
struct Outline {
    std::array<std::vector<double>, 4> x;
    std::array<std::vector<double>, 4> y;
    bool is_whole = true;
};

Outline outline_of(const SourceGrid& grid) {
    Outline outline;
    for (std::size_t edge = 0; edge < 4; ++edge) {
        for (int i = 0; i < edge_points; ++i) {
            const double share = static_cast<double>(i) / (edge_points - 1);
            const double column = edge == 0 ? 0.0 : edge == 1 ? 1.0 : share;
            const double row = edge == 2 ? 0.0 : edge == 3 ? 1.0 : share;
            outline.x[edge].push_back(column * (grid.columns() - 1));
            outline.y[edge].push_back(row * (grid.rows() - 1));
        }
        grid.frame_from_grid(outline.x[edge], outline.y[edge]);
        outline.is_whole =
            outline.is_whole && std::ranges::none_of(outline.x[edge], [](double x) { return std::isnan(x); });
    }
    return outline;
}

MapRectangle bounds_of(const Outline& outline) {
    MapRectangle bounds;
    for (std::size_t edge = 0; edge < 4; ++edge) {
        for (std::size_t i = 0; i < outline.x[edge].size(); ++i) {
            bounds.add({outline.x[edge][i], outline.y[edge][i]});
        }
    }
    return bounds;
}

/// The upright rectangle that lies within all four edges of an upright grid, or all bounds where that would leave too
/// little.
MapRectangle rectangle_of(const Outline& outline) {
    const MapRectangle all = bounds_of(outline);
    MapRectangle within;
    within.min = {std::ranges::max(outline.x[0]), std::ranges::max(outline.y[2])};
    within.max = {std::ranges::min(outline.x[1]), std::ranges::min(outline.y[3])};
    return within.area() >= min_left * all.area() ? within : all;
}

[[noreturn]] void error_no_frame(const path& file, std::string_view got) {
    throw_error_in(file,
        fmt::format("expected ground up to 1000 km wide and away from the poles that a local frame fits, got {}", got));
}

constexpr std::string_view no_way_to_globe =
    "a coordinate system that does not lead to the latitude and longitude of one planet";
constexpr std::string_view no_places = "edges that have no places there";

/// The ellipsoid of the first grid, on which all lie.
Ellipsoid ellipsoid_of(const std::vector<SourceGrid>& grids) { return grids.front().pieces().front().raster.ellipsoid; }

/// The middle of all grids on the globe.
GeoPosition middle_of(const path& file, std::vector<SourceGrid>& grids) {
    const Ellipsoid ellipsoid = ellipsoid_of(grids);
    const SpatialReference globe = geographic_coordinate_system(ellipsoid);
    MapRectangle all;
    std::optional<double> first_deg;
    for (SourceGrid& grid : grids) {
        if (!grid.set_target_frame(globe.get())) { error_no_frame(file, no_way_to_globe); }
        Outline outline = outline_of(grid);
        const double reference_deg = first_deg.value_or(outline.x[0][0]);
        for (std::vector<double>& edge : outline.x) {
            for (double& longitude_deg : edge) {
                longitude_deg = reference_deg + std::remainder(longitude_deg - reference_deg, 360.0);
            }
        }
        if (!outline.is_whole) { error_no_frame(file, no_places); }
        first_deg = reference_deg;
        const MapRectangle own = bounds_of(outline);
        all.add(own.min);
        all.add(own.max);
    }
    const glm::dvec2 middle = 0.5 * (all.min + all.max);
    if (!(all.size().x < 180.0) || std::abs(middle.y) > 90.0) {
        error_no_frame(
            file, fmt::format("{:.1f} x {:.1f} degrees about latitude {:.1f}", all.size().x, all.size().y, middle.y));
    }
    return {middle.y, std::remainder(middle.x, 360.0), ellipsoid};
}

/// The sides of a grid's cells at its middle, in the frame's units.
glm::dvec2 cell_sides(const SourceGrid& grid) {
    const double column = 0.5 * (grid.columns() - 1);
    const double row = 0.5 * (grid.rows() - 1);
    std::array<double, 4> x = {column - 0.5, column + 0.5, column, column};
    std::array<double, 4> y = {row, row, row - 0.5, row + 0.5};
    grid.frame_from_grid(x, y);
    return {std::hypot(x[1] - x[0], y[1] - y[0]), std::hypot(x[3] - x[2], y[3] - y[2])};
}

bool has_length_unit(SpatialReferenceHandle system) {
    return system == nullptr || OSRIsProjected(system) != 0 || OSRIsLocal(system) != 0;
}

void check_systems(const path& file, const std::vector<SourceGrid>& grids) {
    for (const SourceGrid& grid : grids) {
        const path& own = grid.pieces().front().file;
        const SpatialReferenceHandle system = grid.system();
        if (system == nullptr && grids.size() > 1 && grids.front().system() != nullptr) {
            throw_error_in(
                own, fmt::format("expected a coordinate system, as {} has, got none: --terrain-system says which",
                         file.filename().string()));
        }
        if (!has_length_unit(system) && OSRIsGeographic(system) == 0) {
            throw_error_in(own, "expected a map projection or degrees, got another coordinate system");
        }
    }
}

/// Whether all grids have one system, in which lengths are true or cannot be checked.
bool keeps_own_frame(const path& file, std::vector<SourceGrid>& grids) {
    const SpatialReferenceHandle own = grids.front().system();
    if (!has_length_unit(own)) { return false; }
    for (const SourceGrid& grid : grids) {
        const bool same =
            own == nullptr ? grid.system() == nullptr : grid.system() != nullptr && OSRIsSame(own, grid.system()) != 0;
        if (!same) { return false; }
    }
    const SpatialReference globe = geographic_coordinate_system(ellipsoid_of(grids));
    if (own == nullptr || !grids.front().set_target_frame(globe.get())) { return true; }
    const double unit_m = OSRGetLinearUnits(own, nullptr);
    try {
        const SpatialReference about = local_coordinate_system(middle_of(file, grids));
        return std::ranges::all_of(grids, [&](SourceGrid& grid) {
            if (!about || !grid.set_target_frame(about.get())) { return true; }
            const glm::dvec2 ratio = cell_sides(grid) / (grid.map()->steps() * unit_m);
            return std::abs(ratio.x - 1.0) <= scale_tolerance && std::abs(ratio.y - 1.0) <= scale_tolerance;
        });
    } catch (const Error&) {
        return true; // a system without a place that can be told
    }
}

/// The grid with the shortest side of a cell, and that side.
struct Finest {
    const SourceGrid* grid;
    glm::dvec2 sides;

    double side() const { return std::min(sides.x, sides.y); }
};

Finest finest_of(const std::vector<SourceGrid>& grids) {
    Finest finest{nullptr, {}};
    for (const SourceGrid& grid : grids) {
        const Finest own{&grid, cell_sides(grid)};
        if (finest.grid == nullptr || own.side() < finest.side()) { finest = own; }
    }
    return finest;
}

/// The longest step that divides both sides of a cell, where that is at least a third of the shorter one; else the
/// shorter one.
double common_step(const glm::dvec2& sides) {
    const double fine = std::min(sides.x, sides.y);
    const double ratio = std::max(sides.x, sides.y) / fine;
    for (const int parts : {1, 2, 3}) {
        if (std::abs(ratio * parts - std::round(ratio * parts)) <= square_tolerance * parts) { return fine / parts; }
    }
    return fine;
}

/// How many steps fit on a length, forgiving a rounding error of its end, and one more.
double samples_on(double length, double step) { return std::floor(length / step + 1e-6) + 1.0; }

MapRectangle extent_of(const path& file, const std::vector<SourceGrid>& grids) {
    MapRectangle all;
    for (const SourceGrid& grid : grids) {
        const Outline outline = outline_of(grid);
        if (!outline.is_whole) { error_no_frame(file, no_places); }
        const MapRectangle own = rectangle_of(outline);
        all.add(own.min);
        all.add(own.max);
    }
    return all;
}

void lay_samples(const path& file, const MapRectangle& extent, TargetGrid& target) {
    const glm::dvec2 size = extent.size();
    const double columns = samples_on(size.x, target.step);
    const double rows = samples_on(size.y, target.step);
    check_size(file, columns, rows, SourceGrid::largest_samples);
    target.columns = static_cast<int>(columns);
    target.rows = static_cast<int>(rows);
}

TargetGrid target_in_own_frame(const path& file, std::vector<SourceGrid>& grids) {
    const SpatialReferenceHandle own = grids.front().system();
    TargetGrid target;
    target.frame = spatial_reference_of(own);
    target.unit_m = own == nullptr ? 1.0 : OSRGetLinearUnits(own, nullptr);
    for (SourceGrid& grid : grids) { grid.set_target_frame(nullptr); }
    Finest finest = finest_of(grids);
    const GridTransform& map = *finest.grid->map();
    finest.sides = map.steps(); // to the last bit
    target.cell_m = finest.sides * target.unit_m;
    const bool square = std::abs(finest.sides.x / finest.sides.y - 1.0) <= square_tolerance;
    target.is_source = grids.size() == 1 && map.is_upright() && square;
    target.step = target.is_source ? finest.sides.x : common_step(finest.sides);
    const MapRectangle extent = extent_of(file, grids);
    lay_samples(file, extent, target);
    if (map.is_upright()) { // samples of the finest grid are samples of the target
        const auto first = [&](double min, double at) {
            return at + target.step * std::ceil((min - at) / target.step - 1e-6);
        };
        target.west = first(extent.min.x, map.x0);
        target.south = first(extent.min.y, map.y0);
        MapRectangle rest = extent;
        rest.min = {target.west, target.south};
        lay_samples(file, rest, target);
    } else {
        target.west = extent.min.x;
        target.south = extent.min.y;
    }
    return target;
}

TargetGrid target_about_middle(const path& file, std::vector<SourceGrid>& grids) {
    TargetGrid target;
    target.frame = local_coordinate_system(middle_of(file, grids));
    for (SourceGrid& grid : grids) {
        if (!target.frame || !grid.set_target_frame(target.frame.get())) { error_no_frame(file, no_way_to_globe); }
    }
    const MapRectangle extent = extent_of(file, grids);
    if (!(std::max(extent.size().x, extent.size().y) <= widest_m)) {
        error_no_frame(file, fmt::format("{:.0f} x {:.0f} km", 1e-3 * extent.size().x, 1e-3 * extent.size().y));
    }
    const Finest finest = finest_of(grids);
    const double side = finest.side();
    target.cell_m = finest.sides;
    const glm::dvec2 cells = extent.size() / side;
    target.step = 4.0 * cells.x * cells.y <= max_halved ? 0.5 * side : side;
    lay_samples(file, extent, target);
    const glm::dvec2 middle = 0.5 * (extent.min + extent.max);
    target.west = middle.x - 0.5 * (target.columns - 1) * target.step;
    target.south = middle.y - 0.5 * (target.rows - 1) * target.step;
    return target;
}

} // namespace

CoordinateSystem TargetGrid::system() const {
    return {wkt_of(frame.get()), west + 0.5 * (columns - 1) * step, south + 0.5 * (rows - 1) * step, unit_m};
}

TargetGrid target_grid_for(const path& first, std::vector<SourceGrid>& grids) {
    check_systems(first, grids);
    return keeps_own_frame(first, grids) ? target_in_own_frame(first, grids) : target_about_middle(first, grids);
}

namespace {

constexpr std::int64_t max_places = 250000; ///< of samples, and as many of middles

/// The middle of the target, in its frame's units.
glm::dvec2 middle_of(const TargetGrid& target) {
    return {
        target.west + 0.5 * (target.columns - 1) * target.step, target.south + 0.5 * (target.rows - 1) * target.step};
}

/// Takes in the differences between a ground and a row of a grid's places.
class Differences {
public:
    Differences(const SourceGrid& grid, const TargetGrid& target, const GroundAt& ground)
        : grid_(grid), target_(target), ground_(ground), middle_(middle_of(target)) {}

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
            const glm::dvec2 place_m = (glm::dvec2(x_[i], y_[i]) - middle_) * target_.unit_m;
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
    const TargetGrid& target_;
    const GroundAt& ground_;
    glm::dvec2 middle_;
    double squares_ = 0.0;
    std::vector<double> x_;
    std::vector<double> y_;
};

} // namespace

std::optional<double> source_height_m(
    const std::vector<SourceGrid>& grids, const TargetGrid& target, double x_m, double y_m, const GdalSession& gdal) {
    for (const SourceGrid& grid : grids) {
        glm::dvec2 at = middle_of(target) + glm::dvec2(x_m, y_m) / target.unit_m;
        grid.grid_from_frame({&at.x, 1}, {&at.y, 1});
        constexpr double rim = 1e-6;
        if (!(at.x >= -rim && at.y >= -rim && at.x <= grid.columns() - 1 + rim && at.y <= grid.rows() - 1 + rim)) {
            continue;
        }
        const CellPosition cell = cell_at(at, grid.columns(), grid.rows());
        const std::size_t columns = grid.columns() == 1 ? 1 : 2;
        const std::size_t rows = grid.rows() == 1 ? 1 : 2;
        std::array<float, 4> read_m{};
        grid.read({cell.column, static_cast<int>(columns), cell.row, static_cast<int>(rows)},
            std::span(read_m).first(columns * rows), gdal);
        const std::array corners_m{
            read_m[0], read_m[columns - 1], read_m[columns * (rows - 1)], read_m[columns * rows - 1]};
        constexpr double all = 1.0 - 4.0 * rim;
        if (const auto height_m = bilinear_of_known(corners_m, cell.share, all)) { return height_m; }
    }
    return std::nullopt;
}

HeightDeviation deviation_from_source(
    const std::vector<SourceGrid>& grids, const TargetGrid& target, const GroundAt& ground, const GdalSession& gdal) {
    std::int64_t samples = 0;
    for (const SourceGrid& grid : grids) { samples += std::int64_t{grid.columns()} * grid.rows(); }
    const auto between = static_cast<int>(samples / max_places + 1);
    HeightDeviation whole;
    double squares = 0.0;
    for (const SourceGrid& grid : grids) {
        Differences differences(grid, target, ground);
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
