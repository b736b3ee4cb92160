#include "models/heights/local_frame.h"

#include "sim/base/error.h"

#include <algorithm>
#include <cmath>
#include <cpl_conv.h>
#include <fmt/format.h>
#include <ogr_srs_api.h>
#include <string>
#include <utility>

namespace octant::models::heights {

namespace {

constexpr double widest_m = 1.0e6;
/// Points looked at along each edge of a grid when its rectangle is searched.
constexpr int edge_points = 257;
/// Between lattice points so many samples apart source coordinates run linearly: at 100 m spacing
/// the error is 0.05 m, far below a sample.
constexpr int lattice_step = 16;

struct ReleaseReference {
    void operator()(void* reference) const { OSRRelease(reference); }
};

using Reference = std::unique_ptr<void, ReleaseReference>;

struct Point {
    double x = 0.0;
    double y = 0.0;
};

Reference reference_from_proj(const std::string& text) {
    Reference reference(OSRNewSpatialReference(nullptr));
    if (OSRImportFromProj4(reference.get(), text.c_str()) != OGRERR_NONE) {
        return nullptr;
    }
    OSRSetAxisMappingStrategy(reference.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

Transformation between(OGRSpatialReferenceH from, OGRSpatialReferenceH to) {
    return Transformation(OCTNewCoordinateTransformation(from, to));
}

std::optional<Point> moved(const Transformation& transformation, Point point) {
    const bool worked = OCTTransform(transformation.get(), 1, &point.x, &point.y, nullptr) != 0;
    if (!worked || !std::isfinite(point.x) || !std::isfinite(point.y)) {
        return std::nullopt;
    }
    return point;
}

double distance(Point a, Point b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

} // namespace

void CloseTransformation::operator()(void* transformation) const {
    OCTDestroyCoordinateTransformation(transformation);
}

std::string wkt_of(SystemHandle system) {
    char* text = nullptr;
    const bool written = OSRExportToWkt(system, &text) == OGRERR_NONE;
    std::string wkt = written ? text : "";
    CPLFree(text);
    return wkt;
}

MapSystem map_system(SystemHandle system, const GridFrame& frame, int columns, int rows) {
    return {
        wkt_of(system),
        frame.west + 0.5 * (columns - 1) * frame.step_east,
        frame.south + 0.5 * (rows - 1) * frame.step_north,
        OSRGetLinearUnits(system, nullptr)};
}

std::optional<LocalFrame>
LocalFrame::around(SystemHandle system, const GridFrame& frame, int columns, int rows) {
    const Point centre = {
        frame.west + 0.5 * (columns - 1) * frame.step_east,
        frame.south + 0.5 * (rows - 1) * frame.step_north};
    const Reference wgs84 = reference_from_proj("+proj=longlat +datum=WGS84 +no_defs");
    const Transformation to_wgs84 = wgs84 ? between(system, wgs84.get()) : nullptr;
    const std::optional<Point> place = to_wgs84 ? moved(to_wgs84, centre) : std::nullopt;
    if (!place || std::abs(place->y) > 90.0) {
        return std::nullopt;
    }
    const Reference local = reference_from_proj(fmt::format(
        "+proj=tmerc +lat_0={:.17g} +lon_0={:.17g} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m "
        "+no_defs",
        place->y,
        place->x));
    LocalFrame result;
    result.frame_ = frame;
    result.place_ = {place->y, place->x};
    if (!local) {
        return std::nullopt;
    }
    result.wkt_ = wkt_of(local.get());
    result.to_local_ = between(system, local.get());
    result.from_local_ = between(local.get(), system);
    result.local_to_wgs84_ = between(local.get(), wgs84.get());
    if (!result.to_local_ || !result.from_local_ || !result.local_to_wgs84_) {
        return std::nullopt;
    }
    const double half_east = 0.5 * frame.step_east;
    const double half_north = 0.5 * frame.step_north;
    const auto west = moved(result.to_local_, {centre.x - half_east, centre.y});
    const auto east = moved(result.to_local_, {centre.x + half_east, centre.y});
    const auto south = moved(result.to_local_, {centre.x, centre.y - half_north});
    const auto north = moved(result.to_local_, {centre.x, centre.y + half_north});
    if (!west || !east || !south || !north) {
        return std::nullopt;
    }
    result.step_east_m_ = distance(*west, *east);
    result.step_north_m_ = distance(*south, *north);
    return result;
}

std::optional<LocalFrame::Rectangle> LocalFrame::rectangle_within(const HeightGrid& grid) const {
    const double width = (grid.columns - 1) * frame_.step_east;
    const double height = (grid.rows - 1) * frame_.step_north;
    Rectangle inside = {-widest_m, widest_m, -widest_m, widest_m};
    for (int i = 0; i < edge_points; ++i) {
        const double part = static_cast<double>(i) / (edge_points - 1);
        const double x = frame_.west + part * width;
        const double y = frame_.south + part * height;
        const auto west = moved(to_local_, {frame_.west, y});
        const auto east = moved(to_local_, {frame_.west + width, y});
        const auto south = moved(to_local_, {x, frame_.south});
        const auto north = moved(to_local_, {x, frame_.south + height});
        if (!west || !east || !south || !north || distance(*west, *east) > widest_m ||
            distance(*south, *north) > widest_m) {
            return std::nullopt;
        }
        inside.west_m = std::max(inside.west_m, west->x);
        inside.east_m = std::min(inside.east_m, east->x);
        inside.south_m = std::max(inside.south_m, south->y);
        inside.north_m = std::min(inside.north_m, north->y);
    }
    return inside;
}

/// Heights row by row, source coordinates interpolated between exact ones on a lattice.
bool LocalFrame::fill(
    LocalGrid& local, double west_m, double south_m, const HeightGrid& grid) const {
    const int across = (local.grid.columns - 1) / lattice_step + 2;
    const auto lattice_row = [&](int row, std::vector<Point>& points) {
        std::vector<double> x(static_cast<std::size_t>(across));
        std::vector<double> y(x.size(), south_m + row * lattice_step * local.spacing_m);
        for (std::size_t i = 0; i < x.size(); ++i) {
            x[i] = west_m + static_cast<double>(i) * lattice_step * local.spacing_m;
        }
        const bool worked =
            OCTTransform(from_local_.get(), across, x.data(), y.data(), nullptr) != 0;
        points.resize(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) {
            points[i] = {
                (x[i] - frame_.west) / frame_.step_east, (y[i] - frame_.south) / frame_.step_north};
        }
        return worked;
    };
    std::vector<Point> low;
    std::vector<Point> high;
    for (int row = 0; row < local.grid.rows; ++row) {
        if (row % lattice_step == 0) {
            std::swap(low, high);
            if ((row == 0 && !lattice_row(0, low)) || !lattice_row(row / lattice_step + 1, high)) {
                return false;
            }
        }
        const double v = static_cast<double>(row % lattice_step) / lattice_step;
        for (int column = 0; column < local.grid.columns; ++column) {
            const auto i = static_cast<std::size_t>(column / lattice_step);
            const double u = static_cast<double>(column % lattice_step) / lattice_step;
            const auto mixed = [u, v](double a, double b, double c, double d) {
                return (a * (1.0 - u) + b * u) * (1.0 - v) + (c * (1.0 - u) + d * u) * v;
            };
            local.grid.heights_m.push_back(interpolated(
                grid,
                mixed(low[i].x, low[i + 1].x, high[i].x, high[i + 1].x),
                mixed(low[i].y, low[i + 1].y, high[i].y, high[i + 1].y)));
        }
    }
    return true;
}

std::optional<LocalGrid> LocalFrame::resampled(const HeightGrid& grid) const {
    const auto inside = rectangle_within(grid);
    if (!inside) {
        return std::nullopt;
    }
    LocalGrid local;
    local.spacing_m = std::sqrt(step_east_m_ * step_north_m_);
    const double width_m = inside->east_m - inside->west_m;
    const double height_m = inside->north_m - inside->south_m;
    if (!(width_m >= local.spacing_m && height_m >= local.spacing_m)) {
        return std::nullopt;
    }
    local.grid.columns = static_cast<int>(width_m / local.spacing_m) + 1;
    local.grid.rows = static_cast<int>(height_m / local.spacing_m) + 1;
    local.grid.heights_m.reserve(
        static_cast<std::size_t>(local.grid.columns) * static_cast<std::size_t>(local.grid.rows));
    const Point centre = {
        0.5 * (inside->west_m + inside->east_m), 0.5 * (inside->south_m + inside->north_m)};
    const auto place = moved(local_to_wgs84_, centre);
    const double west_m = centre.x - 0.5 * (local.grid.columns - 1) * local.spacing_m;
    const double south_m = centre.y - 0.5 * (local.grid.rows - 1) * local.spacing_m;
    if (!place || !fill(local, west_m, south_m, grid)) {
        return std::nullopt;
    }
    local.place = {place->y, place->x};
    local.system = {wkt_, centre.x, centre.y, 1.0};
    return local;
}

} // namespace octant::models::heights
