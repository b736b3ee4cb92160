#include "models/heights/local_frame.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "sim/base/error.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <vector>

namespace octant::models::heights {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
/// MapFrame uses the map's system up to this distance. No ground is wider.
constexpr double furthest_m = 1.0e6;

SpatialReference counted(OGRSpatialReferenceH system) {
    return {system, [](void* own) { OSRRelease(own); }};
}

/// The system that GDAL makes of a text, x before y; null if it makes none.
SpatialReference reference_from(const std::string& text) {
    SpatialReference reference = counted(OSRNewSpatialReference(nullptr));
    if (OSRSetFromUserInput(reference.get(), text.c_str()) != OGRERR_NONE) { return nullptr; }
    OSRSetAxisMappingStrategy(reference.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

/// The way on the ground between two places that lie close together, metres east and north.
glm::dvec2 way_m(const glm::dvec2& from_deg, const glm::dvec2& to_deg, const Ellipsoid& ellipsoid) {
    const double e2 = ellipsoid.e2();
    const double equator_m = ellipsoid.semi_major_m;
    constexpr double rad = std::numbers::pi / 180.0;
    const double latitude = 0.5 * (from_deg.y + to_deg.y) * rad;
    const double root = std::sqrt(1.0 - e2 * std::sin(latitude) * std::sin(latitude));
    const double across_m = equator_m / root;
    const double along_m = equator_m * (1.0 - e2) / (root * root * root);
    const double east_deg = std::remainder(to_deg.x - from_deg.x, 360.0);
    return {east_deg * rad * across_m * std::cos(latitude), (to_deg.y - from_deg.y) * rad * along_m};
}

/// How PROJ is told of an ellipsoid.
std::string proj_text(const Ellipsoid& ellipsoid) {
    return ellipsoid.is_earth()
               ? "+datum=WGS84"
               : fmt::format("+a={:.17g} +b={:.17g}", ellipsoid.semi_major_m, ellipsoid.semi_minor_m());
}

} // namespace

void TransformationDeleter::operator()(void* transformation) const {
    OCTDestroyCoordinateTransformation(transformation);
}

glm::dvec2 GridTransform::steps() const { return {std::hypot(x_column, y_column), std::hypot(x_row, y_row)}; }

GridTransform GridTransform::inverse() const {
    const double area = x_column * y_row - x_row * y_column;
    GridTransform back;
    back.x_column = y_row / area;
    back.x_row = -x_row / area;
    back.y_column = -y_column / area;
    back.y_row = x_column / area;
    back.x0 = -(back.x_column * x0 + back.x_row * y0);
    back.y0 = -(back.y_column * x0 + back.y_row * y0);
    return back;
}

std::string wkt_of(SpatialReferenceHandle system) {
    char* text = nullptr;
    const bool written = OSRExportToWkt(system, &text) == OGRERR_NONE;
    std::string wkt = written ? text : "";
    CPLFree(text);
    return wkt;
}

Ellipsoid ellipsoid_of(const std::string& wkt) {
    std::size_t at = wkt.find("SPHEROID[");
    at = at == std::string::npos ? wkt.find("ELLIPSOID[") : at;
    at = at == std::string::npos ? at : wkt.find("\",", at);
    if (at == std::string::npos) { return {}; }
    Ellipsoid named{0.0, 0.0};
    double inverse_flattening = 0.0; // of a sphere
    const char* const end = wkt.data() + wkt.size();
    const auto major = std::from_chars(wkt.data() + at + 2, end, named.semi_major_m);
    if (major.ptr < end) { std::from_chars(major.ptr + 1, end, inverse_flattening); }
    named.flattening = inverse_flattening > 1.0 ? 1.0 / inverse_flattening : 0.0;
    constexpr double smallest_m = 1000.0;
    constexpr double largest_m = 1e9;
    const bool is_sound = named.semi_major_m >= smallest_m && named.semi_major_m <= largest_m;
    return !is_sound || named.is_earth() ? Ellipsoid() : named;
}

SpatialReference geographic_coordinate_system(const Ellipsoid& ellipsoid) {
    return reference_from(fmt::format("+proj=longlat {} +no_defs", proj_text(ellipsoid)));
}

SpatialReference coordinate_system_from_name(const std::string& name) {
    const bool is_address = name.find("://") != std::string::npos;
    SpatialReference reference = is_address ? nullptr : reference_from(name);
    if (!reference) {
        throw Error(
            fmt::format("--terrain-system: expected a coordinate system such as EPSG:4326, got '{}'", printable(name)));
    }
    return reference;
}

SpatialReference spatial_reference_of(SpatialReferenceHandle system) {
    return system == nullptr ? nullptr : counted(OSRClone(system));
}

SpatialReference local_coordinate_system(const GeoPosition& place) {
    return reference_from(
        fmt::format("+proj=tmerc +lat_0={:.17g} +lon_0={:.17g} +k=1 +x_0=0 +y_0=0 {} +units=m +no_defs",
            place.latitude_deg, place.longitude_deg, proj_text(place.ellipsoid)));
}

Transformation between(SpatialReferenceHandle from, SpatialReferenceHandle to) {
    return Transformation(OCTNewCoordinateTransformation(from, to));
}

void transform_points(const Transformation& by, std::span<double> x, std::span<double> y) {
    if (!by || x.empty()) { return; }
    std::vector<int> worked(x.size(), 0);
    OCTTransformEx(by.get(), static_cast<int>(x.size()), x.data(), y.data(), nullptr, worked.data());
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (worked[i] == 0 || !std::isfinite(x[i]) || !std::isfinite(y[i])) {
            x[i] = no_number;
            y[i] = no_number;
        }
    }
}

std::optional<glm::dvec2> moved(const Transformation& by, glm::dvec2 point) {
    transform_points(by, {&point.x, 1}, {&point.y, 1});
    return std::isnan(point.x) ? std::nullopt : std::optional(point);
}

std::optional<ProjectionDistortion> distortion_at_corners(
    const CoordinateSystem& system, const glm::dvec2& half_extent_m) {
    const GdalSession gdal;
    const SpatialReference own = reference_from(system.wkt);
    if (!own) { return std::nullopt; }
    const Ellipsoid ellipsoid = ellipsoid_of(wkt_of(own.get()));
    const SpatialReference globe = geographic_coordinate_system(ellipsoid);
    const Transformation to_globe = between(own.get(), globe.get());
    if (!to_globe) { return std::nullopt; }
    constexpr double step_m = 50.0;
    ProjectionDistortion worst;
    for (const double side : {-1.0, 1.0}) {
        for (const double end : {-1.0, 1.0}) {
            const glm::dvec2 corner =
                glm::dvec2(system.centre_x, system.centre_y) + glm::dvec2(side, end) * half_extent_m / system.unit_m;
            const auto at = moved(to_globe, corner);
            const auto east = moved(to_globe, corner + glm::dvec2(step_m / system.unit_m, 0.0));
            const auto north = moved(to_globe, corner + glm::dvec2(0.0, step_m / system.unit_m));
            if (!at || !east || !north) { return std::nullopt; }
            for (const auto& to : {*east, *north}) {
                const glm::dvec2 way = way_m(*at, to, ellipsoid);
                worst.scale_percent =
                    std::max(worst.scale_percent, 100.0 * std::abs(step_m / std::hypot(way.x, way.y) - 1.0));
            }
            const glm::dvec2 up = way_m(*at, *north, ellipsoid);
            worst.turn_deg = std::max(worst.turn_deg, std::abs(std::atan2(up.x, up.y)) * 180.0 / std::numbers::pi);
        }
    }
    return worst;
}

namespace {

class MapFrame final : public EarthFrame {
public:
    /// `system` must be georeferenced; `middle` is the geographic position of the ground's centre.
    MapFrame(const CoordinateSystem& system, const GeoPosition& middle) : system_(system), about_(middle) {
        const GdalSession gdal;
        const SpatialReference own = reference_from(system.wkt);
        const SpatialReference globe = geographic_coordinate_system(middle.ellipsoid);
        if (own) {
            from_globe_ = between(globe.get(), own.get());
            to_globe_ = between(own.get(), globe.get());
        }
    }

    GeoPosition origin() const override { return about_.origin(); }

    glm::dvec2 local_from_geo(const GeoPosition& place) const override {
        const glm::dvec2 about_m = about_.local_from_geo(place);
        if (!from_globe_ || !(glm::length(about_m) <= furthest_m)) { return about_m; }
        const GdalSession gdal;
        const auto at = moved(from_globe_, {place.longitude_deg, place.latitude_deg});
        return at ? (*at - centre()) * system_.unit_m : about_m;
    }

    GeoPosition geo_from_local(const glm::dvec2& east_north_m) const override {
        const bool asks = to_globe_ && glm::length(east_north_m) <= furthest_m;
        const GdalSession gdal;
        const auto at = asks ? moved(to_globe_, centre() + east_north_m / system_.unit_m) : std::nullopt;
        return at ? GeoPosition{std::clamp(at->y, -90.0, 90.0), at->x, about_.origin().ellipsoid}
                  : about_.geo_from_local(east_north_m);
    }

private:
    glm::dvec2 centre() const { return {system_.centre_x, system_.centre_y}; }

    CoordinateSystem system_;
    TransverseMercator about_;
    Transformation from_globe_;
    Transformation to_globe_;
};

} // namespace

std::shared_ptr<const EarthFrame> frame_of_ground(
    const std::optional<CoordinateSystem>& system, const std::optional<GeoPosition>& place) {
    if (!place) { return nullptr; }
    if (!system) { return std::make_shared<TransverseMercator>(*place); }
    return std::make_shared<MapFrame>(*system, *place);
}

} // namespace octant::models::heights
