#include "models/heights/map_frame.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::models::heights {

namespace {

/// How far away systems are still asked: no ground is wider.
constexpr double furthest_m = 1.0e6;

} // namespace

MapFrame::MapFrame(const CoordinateSystem& system, const GeoPosition& middle) : system_(system), about_(middle) {
    const GdalSession gdal;
    const SpatialReference own = coordinate_system_of(system);
    const SpatialReference globe = geographic_coordinate_system(middle.ellipsoid);
    if (own) {
        from_globe_ = between(globe.get(), own.get());
        to_globe_ = between(own.get(), globe.get());
    }
}

glm::dvec2 MapFrame::local_from_geo(const GeoPosition& place) const {
    const glm::dvec2 about_m = about_.local_from_geo(place);
    if (!from_globe_ || !(glm::length(about_m) <= furthest_m)) { return about_m; }
    const GdalSession gdal;
    const auto at = moved(from_globe_, {place.longitude_deg, place.latitude_deg});
    const glm::dvec2 centre(system_.centre_x, system_.centre_y);
    return at ? (*at - centre) * system_.unit_m : about_m;
}

GeoPosition MapFrame::geo_from_local(const glm::dvec2& east_north_m) const {
    const glm::dvec2 centre(system_.centre_x, system_.centre_y);
    const bool asks = to_globe_ && glm::length(east_north_m) <= furthest_m;
    const GdalSession gdal;
    const auto at = asks ? moved(to_globe_, centre + east_north_m / system_.unit_m) : std::nullopt;
    return at ? GeoPosition{std::clamp(at->y, -90.0, 90.0), at->x, about_.origin().ellipsoid}
              : about_.geo_from_local(east_north_m);
}

std::shared_ptr<const EarthFrame> frame_of_ground(
    const std::optional<CoordinateSystem>& system, const std::optional<GeoPosition>& place) {
    if (!place) { return nullptr; }
    if (!system) { return std::make_shared<TransverseMercator>(*place); }
    return std::make_shared<MapFrame>(*system, *place);
}

} // namespace octant::models::heights
