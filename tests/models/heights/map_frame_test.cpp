#include "models/heights/map_frame.h"
#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>

using namespace octant;
using namespace octant::models::heights;

TEST_CASE("places lie on a map of UTM where UTM has them, with its north") {
    const CoordinateSystem utm_10{"EPSG:32610", 492729.777625, 5460811.038490, 1.0}; // 49.3 N, 123.1 W
    const auto frame = frame_of_ground(utm_10, GeoPosition{49.3, -123.1});
    REQUIRE(frame);
    const FramePosition local = frame->place_of({49.0, -122.5});
    const glm::dvec2 by_utm_m(536571.198290 - 492729.777625, 5427576.213112 - 5460811.038490);
    CHECK(glm::distance(local.east_north_m, by_utm_m) < 1e-4);
    CHECK(local.north_bearing_rad == Approx(-rad_from_deg(0.3773589490619858)).margin(1e-7));
    const GeoPosition back = frame->geo_from_local(by_utm_m);
    CHECK(back.latitude_deg == Approx(49.0).margin(1e-9));
    CHECK(back.longitude_deg == Approx(-122.5).margin(1e-9));
}

TEST_CASE("systems in other units and of other projections have their own frames") {
    const CoordinateSystem lambert{"EPSG:2154", 625422.4046271729, 6767095.930771305, 1.0};
    const auto paris = frame_of_ground(lambert, GeoPosition{48.0, 2.0});
    const FramePosition origin = paris->place_of({48.0, 2.0});
    CHECK(glm::length(origin.east_north_m) < 1e-4);
    CHECK(origin.north_bearing_rad == Approx(rad_from_deg(0.7256077650551039)).margin(1e-7));
    constexpr double foot_m = 1200.0 / 3937.0;
    const CoordinateSystem feet{"EPSG:2227", 6000000.0, 2100000.0, foot_m}; // California zone 3
    const auto bay = frame_of_ground(feet, GeoPosition{37.75, -122.44});
    const glm::dvec2 way_m = bay->local_from_geo({37.76, -122.44}) - bay->local_from_geo({37.75, -122.44});
    CHECK(glm::length(way_m) == Approx(1110.0).epsilon(1e-3));
}

TEST_CASE("by PROJ and by its own series a transverse Mercator frame is the same") {
    const GeoPosition middle{-33.5, 151.2};
    const CoordinateSystem about{
        "+proj=tmerc +lat_0=-33.5 +lon_0=151.2 +k=1 +datum=WGS84 +units=m +no_defs", 0.0, 0.0, 1.0};
    const auto by_proj = frame_of_ground(about, middle);
    const auto own = frame_of_ground(std::nullopt, middle);
    for (const GeoPosition& place : {GeoPosition{-33.5, 151.2}, {-31.0, 155.0}, {-36.0, 149.0}}) {
        CHECK(glm::distance(by_proj->local_from_geo(place), own->local_from_geo(place)) < 1e-5);
    }
}

TEST_CASE("where a system does not reach, a map's frame goes on, and ground without a place has none") {
    const CoordinateSystem utm_10{"EPSG:32610", 492729.777625, 5460811.038490, 1.0};
    const auto frame = frame_of_ground(utm_10, GeoPosition{49.3, -123.1});
    for (const GeoPosition& place : {GeoPosition{-49.3, 56.9}, {90.0, 0.0}, {0.0, -33.1}}) {
        CHECK(std::isfinite(glm::length(frame->local_from_geo(place))));
    }
    CHECK(std::abs(frame->geo_from_local({1e9, -1e9}).latitude_deg) <= 90.0);
    CHECK(frame_of_ground(utm_10, std::nullopt) == nullptr);
    const auto unknown = frame_of_ground(CoordinateSystem{"no system", 0.0, 0.0, 1.0}, GeoPosition{1.0, 2.0});
    CHECK(glm::length(unknown->local_from_geo({1.0, 2.0})) < 1e-6);
}
