#include "models/heights/target_grid.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/map_rectangle.h"
#include "sim/base/error.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

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
    within.least = {std::ranges::max(outline.x[0]), std::ranges::max(outline.y[2])};
    within.most = {std::ranges::min(outline.x[1]), std::ranges::min(outline.y[3])};
    return within.area() >= min_left * all.area() ? within : all;
}

[[noreturn]] void error_no_frame(const path& file, std::string_view got) {
    throw_error_in(
        file, fmt::format("expected ground up to 1000 km wide and away from the poles that a local frame fits, "
                          "got {}",
                  got));
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
        all.add(own.least);
        all.add(own.most);
    }
    const glm::dvec2 middle = 0.5 * (all.least + all.most);
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
            throw_error_in(own, fmt::format("expected a coordinate system, as {} has, got none: --terrain-system says "
                                            "which",
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

void check_samples(const path& file, double columns, double rows) {
    const auto fits = [](double n) { return n >= 2.0 && n <= SourceGrid::largest_samples; };
    if (!fits(columns) || !fits(rows)) {
        throw_error_in(file, fmt::format("expected 2 x 2 to {0} x {0} samples, got {1:.0f} x {2:.0f}",
                                 static_cast<int>(SourceGrid::largest_samples), columns, rows));
    }
}

/// How many steps fit on a length, forgiving a rounding error of its end, and one more.
double samples_on(double length, double step) { return std::floor(length / step + 1e-6) + 1.0; }

MapRectangle extent_of(const path& file, const std::vector<SourceGrid>& grids) {
    MapRectangle all;
    for (const SourceGrid& grid : grids) {
        const Outline outline = outline_of(grid);
        if (!outline.is_whole) { error_no_frame(file, no_places); }
        const MapRectangle own = rectangle_of(outline);
        all.add(own.least);
        all.add(own.most);
    }
    return all;
}

void lay_samples(const path& file, const MapRectangle& extent, TargetGrid& lattice) {
    const glm::dvec2 size = extent.size();
    const double columns = samples_on(size.x, lattice.step);
    const double rows = samples_on(size.y, lattice.step);
    check_samples(file, columns, rows);
    lattice.columns = static_cast<int>(columns);
    lattice.rows = static_cast<int>(rows);
}

TargetGrid lattice_in_own_frame(const path& file, std::vector<SourceGrid>& grids) {
    const SpatialReferenceHandle own = grids.front().system();
    TargetGrid lattice;
    lattice.frame = spatial_reference_of(own);
    lattice.unit_m = own == nullptr ? 1.0 : OSRGetLinearUnits(own, nullptr);
    for (SourceGrid& grid : grids) { grid.set_target_frame(nullptr); }
    Finest finest = finest_of(grids);
    const GridTransform& map = *finest.grid->map();
    finest.sides = map.steps(); // to the last bit
    lattice.cell_m = finest.sides * lattice.unit_m;
    const bool square = std::abs(finest.sides.x / finest.sides.y - 1.0) <= square_tolerance;
    lattice.is_source = grids.size() == 1 && map.is_upright() && square;
    lattice.step = lattice.is_source ? finest.sides.x : common_step(finest.sides);
    const MapRectangle extent = extent_of(file, grids);
    lay_samples(file, extent, lattice);
    if (map.is_upright()) { // samples of the finest grid are samples of the lattice
        const auto first = [&](double least, double at) {
            return at + lattice.step * std::ceil((least - at) / lattice.step - 1e-6);
        };
        lattice.west = first(extent.least.x, map.x0);
        lattice.south = first(extent.least.y, map.y0);
        MapRectangle rest = extent;
        rest.least = {lattice.west, lattice.south};
        lay_samples(file, rest, lattice);
    } else {
        lattice.west = extent.least.x;
        lattice.south = extent.least.y;
    }
    return lattice;
}

TargetGrid lattice_about_middle(const path& file, std::vector<SourceGrid>& grids) {
    TargetGrid lattice;
    lattice.frame = local_coordinate_system(middle_of(file, grids));
    for (SourceGrid& grid : grids) {
        if (!lattice.frame || !grid.set_target_frame(lattice.frame.get())) { error_no_frame(file, no_way_to_globe); }
    }
    const MapRectangle extent = extent_of(file, grids);
    if (!(std::max(extent.size().x, extent.size().y) <= widest_m)) {
        error_no_frame(file, fmt::format("{:.0f} x {:.0f} km", 1e-3 * extent.size().x, 1e-3 * extent.size().y));
    }
    const Finest finest = finest_of(grids);
    const double side = finest.side();
    lattice.cell_m = finest.sides;
    const glm::dvec2 cells = extent.size() / side;
    lattice.step = 4.0 * cells.x * cells.y <= max_halved ? 0.5 * side : side;
    lay_samples(file, extent, lattice);
    const glm::dvec2 middle = 0.5 * (extent.least + extent.most);
    lattice.west = middle.x - 0.5 * (lattice.columns - 1) * lattice.step;
    lattice.south = middle.y - 0.5 * (lattice.rows - 1) * lattice.step;
    return lattice;
}

} // namespace

CoordinateSystem TargetGrid::system() const {
    return {wkt_of(frame.get()), west + 0.5 * (columns - 1) * step, south + 0.5 * (rows - 1) * step, unit_m};
}

TargetGrid target_grid_for(const path& first, std::vector<SourceGrid>& grids) {
    check_systems(first, grids);
    return keeps_own_frame(first, grids) ? lattice_in_own_frame(first, grids) : lattice_about_middle(first, grids);
}

} // namespace octant::models::heights
