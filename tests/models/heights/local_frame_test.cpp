#include "models/heights/gdal_session.h"
#include "models/heights/height_field_export.h"
#include "models/heights/height_source.h"
#include "models/heights/local_frame.h"
#include "sim/base/axes.h"
#include "sim/base/earth_frame.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "tests/models/heights/sample_maps.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace octant;
using namespace octant::models::heights;
using namespace octant::models::heights::test;

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

namespace {

constexpr double mars_m = 3396190.0;
constexpr double moon_m = 1737400.0;
constexpr double rad = std::numbers::pi / 180.0;

HeightField read_with_system(RasterFile raster, const std::string& system) {
    raster.system = system;
    const auto path = scratch_file("planet.tif");
    write_raster(path, "GTiff", raster);
    return read_height_field(path);
}

RasterFile flat(double height) {
    RasterFile raster = hills(60, 60);
    raster.type = GDT_Float32;
    raster.values.assign(raster.values.size(), height);
    return raster;
}

} // namespace

TEST_CASE("an equirectangular map of Mars seen at 60 degrees has cells half as wide as long") {
    RasterFile raster = flat(-2400.0);
    raster.transform = {0.0, 463.0, 0.0, 3556000.0, 0.0, -463.0};
    const HeightField field = read_with_system(raster, "+proj=eqc +R=3396190 +units=m");
    REQUIRE(field.place);
    // By gdalinfo: centre at 59d45'27.14" N, 0d14'3.60" E.
    CHECK(field.place->latitude_deg == Approx(59.757539).margin(1e-3));
    CHECK(field.place->longitude_deg == Approx(0.234333).margin(1e-3));
    CHECK(field.place->ellipsoid.semi_major_m == mars_m);
    CHECK(field.place->ellipsoid.flattening == 0.0);
    const double cell_m = 463.0 * std::cos(59.757539 * rad); // 233.2 m
    CHECK(2.0 * field.half_extent_m().x == Approx(58.5 * cell_m).epsilon(0.01));
    CHECK(2.0 * field.half_extent_m().y == Approx(59.0 * 463.0).epsilon(0.01));
}

TEST_CASE("with its standard parallel there, an equirectangular map is taken sample by sample") {
    RasterFile raster = flat(100.0);
    const double y_m = 60.0 * rad * mars_m;
    raster.transform = {0.0, 100.0, 0.0, y_m, 0.0, -100.0};
    const HeightField field = read_with_system(raster, "+proj=eqc +lat_ts=60 +R=3396190 +units=m");
    CHECK(field.columns() == 60);
    CHECK(field.spacing_m() == 100.0);
}

TEST_CASE("degrees of Mars are as long as its ellipsoid has them") {
    RasterFile raster = flat(-2400.0);
    raster.transform = {-134.0, 1.0 / 128.0, 0.0, 18.0, 0.0, -1.0 / 128.0};
    const HeightField field = read_with_system(raster,
        "GEOGCS[\"GCS_Mars_2000\",DATUM[\"D_Mars_2000\",SPHEROID[\"Mars_2000_IAU_IAG\",3396190,169."
        "894447223612]],PRIMEM[\"Reference_Meridian\",0],UNIT[\"degree\",0.0174532925199433]]");
    REQUIRE(field.place);
    CHECK(field.place->latitude_deg == Approx(17.765625).margin(0.01));
    // Radii of curvature by hand: 3,398,048 m across and 3,361,839 m along the meridian.
    const double east_m = 3398048.0 * std::cos(17.765625 * rad) * rad / 128.0;
    const double north_m = 3361839.0 * rad / 128.0;
    CHECK(2.0 * field.half_extent_m().x == Approx(58.5 * east_m).epsilon(0.01));
    CHECK(2.0 * field.half_extent_m().y == Approx(58.7 * north_m).epsilon(0.01));
    const auto frame = frame_of_ground(field.system, field.place);
    const double degree_m = 1.0 * rad * 3361839.0;
    CHECK(frame->local_from_geo({field.place->latitude_deg + 1.0, field.place->longitude_deg}).y ==
          Approx(degree_m).epsilon(1e-3));
}

TEST_CASE("Olympus Mons is believed on Mars and not on the earth") {
    RasterFile raster = flat(21229.0);
    raster.transform = {0.0, 463.0, 0.0, 1000000.0, 0.0, -463.0};
    CHECK(read_with_system(raster, "+proj=eqc +R=3396190 +units=m").highest_m() == 21229.0F);
    CHECK_THROWS_AS(read_with_system(raster, "EPSG:32610"), Error);
    raster.values.assign(raster.values.size(), 40000.0);
    CHECK_THROWS_AS(read_with_system(raster, "+proj=eqc +R=3396190 +units=m"), Error);
}

TEST_CASE("distances from the centre of the Moon become heights, with a note") {
    RasterFile raster = flat(moon_m + 1234.0);
    raster.type = GDT_Float64;
    raster.transform = {0.0, 100.0, 0.0, 5000.0, 0.0, -100.0};
    const HeightField field = read_with_system(raster, "+proj=stere +lat_0=-90 +R=1737400 +units=m");
    CHECK(field.lowest_m() == 1234.0F);
    REQUIRE(field.notes.size() == 1);
    CHECK(field.notes.front().text.find("centre of the Moon") != std::string::npos);
    raster.values.assign(raster.values.size(), 2468.0); // as LOLA's archive has them
    raster.type = GDT_Int16;
    raster.scale = 0.5;
    raster.offset = moon_m;
    CHECK(read_with_system(raster, "+proj=stere +lat_0=-90 +R=1737400 +units=m").lowest_m() == 1234.0F);
}

TEST_CASE("files of two planets make no ground") {
    RasterFile raster = flat(0.0);
    raster.transform = {0.0, 0.01, 0.0, 1.0, 0.0, -0.01};
    raster.system = "+proj=longlat +R=3396190";
    const auto mars = scratch_file("mars.tif");
    write_raster(mars, "GTiff", raster);
    raster.system = "+proj=longlat +R=1737400";
    const auto moon = scratch_file("moon.tif");
    write_raster(moon, "GTiff", raster);
    CHECK_THROWS_AS(read_height_field({mars, moon}), Error);
}

TEST_CASE("a map of Mars that is written and read again lies at its place on Mars") {
    RasterFile raster = flat(-2400.0);
    raster.transform = {0.0, 463.0, 0.0, 3556000.0, 0.0, -463.0};
    const HeightField field = read_with_system(raster, "+proj=eqc +R=3396190 +units=m");
    const auto path = scratch_file("again.tif");
    write_height_field(path, field);
    const HeightField again = read_height_field(path);
    REQUIRE(again.place);
    CHECK(again.place->ellipsoid.semi_major_m == mars_m);
    CHECK(again.place->latitude_deg == Approx(field.place->latitude_deg).margin(1e-6));
    CHECK(again.spacing_m() == Approx(field.spacing_m()));
}

TEST_CASE("an ellipsoid is read from a system's text, and every one of the earth is WGS 84") {
    const GeoPosition place{10.0, 20.0, {moon_m, 0.0}};
    const GdalSession gdal;
    CHECK(ellipsoid_of(wkt_of(local_coordinate_system(place).get())) == place.ellipsoid);
    CHECK(ellipsoid_of(wkt_of(coordinate_system_from_name("EPSG:31467").get())) == wgs84); // Bessel's
    CHECK(ellipsoid_of("no system") == wgs84);
    CHECK(ellipsoid_of("SPHEROID[\"x\",") == wgs84);
    CHECK(ellipsoid_of("SPHEROID[\"x\",-3,nan]") == wgs84);
}

TEST_CASE("on a sphere the frame's metres north are its radius by the angle") {
    const TransverseMercator frame({-30.0, 40.0, {moon_m, 0.0}});
    CHECK(frame.local_from_geo({-29.0, 40.0}).y == Approx(moon_m * rad).epsilon(1e-12));
    const GeoPosition back = frame.geo_from_local({5000.0, -7000.0});
    CHECK(back.ellipsoid == frame.origin().ellipsoid);
    CHECK(glm::distance(frame.local_from_geo(back), glm::dvec2(5000.0, -7000.0)) < 1e-6);
}

TEST_CASE("bodies are known by their size") {
    CHECK(name_of_body({mars_m, 0.0}) == "Mars");
    CHECK(name_of_body({moon_m, 0.0}) == "the Moon");
    CHECK(name_of_body(wgs84) == "the earth");
    CHECK(name_of_body({252000.0, 0.0}) == "a body with a radius of 252 km");
    CHECK(wgs84.mean_radius_m() == 6371000.0);
    CHECK(Ellipsoid{6378206.4, 1.0 / 294.98}.is_earth()); // Clarke's
    CHECK_FALSE(Ellipsoid{6051800.0, 0.0}.is_earth());    // Venus
}
