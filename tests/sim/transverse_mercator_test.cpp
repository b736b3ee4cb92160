#include "sim/base/axes.h"
#include "sim/base/earth_frame.h"
#include "sim/base/units.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>

using namespace octant;

namespace {

/// Where PROJ 9.1 has a place: +proj=tmerc +k=1 +ellps=WGS84.
struct Known {
    GeoPosition origin;
    GeoPosition place;
    glm::dvec2 at_m;
    double convergence_deg;
};

constexpr Known known[] = {{{47.0, 8.0}, {48.5, 10.25}, {166273.011028, 169223.933968}, 1.6855341264},
    {{-33.5, 179.99}, {-33.4, -179.9}, {10233.219568, 11085.841690}, -0.0605529340}, // date line
    {{89.99, 20.0}, {89.98, -150.0}, {-387.909113, 3316.881738}, -170.0000005970},   // pole
    {{64.0, -21.9}, {64.2, -21.2}, {34006.659678, 22482.808628}, 0.6302291024}};

} // namespace

TEST_CASE("places lie in a transverse Mercator frame where PROJ has them, and come back") {
    for (const Known& each : known) {
        const TransverseMercator frame(each.origin);
        const FramePosition local = frame.place_of(each.place);
        CHECK(glm::distance(local.east_north_m, each.at_m) < 2e-6);
        CHECK(std::abs(wrapped_to_pi(local.north_bearing_rad + rad_from_deg(each.convergence_deg))) < 1e-6);
        const GeoPosition back = frame.geo_from_local(local.east_north_m);
        CHECK(back.latitude_deg == Approx(each.place.latitude_deg).margin(1e-11));
        CHECK(std::abs(std::remainder(back.longitude_deg - each.place.longitude_deg, 360.0)) < 1e-7);
    }
}

TEST_CASE("a way over the pole has no jump, and north turns round on it") {
    const TransverseMercator frame({89.99, 20.0});
    const FramePosition before = frame.place_of({89.9999, 20.0});
    const FramePosition behind = frame.place_of({89.9999, -160.0});
    CHECK(glm::distance(before.east_north_m, behind.east_north_m) == Approx(22.34).margin(0.01));
    CHECK(before.north_bearing_rad == Approx(0.0).margin(1e-9));
    CHECK(std::abs(behind.north_bearing_rad) == Approx(pi));
}

TEST_CASE("every place on the earth is finite in a frame, and what comes back is on the earth") {
    const TransverseMercator frame({47.0, 8.0});
    for (double latitude_deg = -90.0; latitude_deg <= 90.0; latitude_deg += 15.0) {
        for (double longitude_deg = -360.0; longitude_deg <= 360.0; longitude_deg += 30.0) {
            const FramePosition local = frame.place_of({latitude_deg, longitude_deg});
            CHECK(std::isfinite(local.east_north_m.x));
            CHECK(std::isfinite(local.east_north_m.y));
            CHECK(std::isfinite(local.north_bearing_rad));
        }
    }
    for (const glm::dvec2& at_m : {glm::dvec2(1e12, 3.0), {-5.0, -1e12}, {4e6, 9e6}, {0.0, 4.8e6}}) {
        const GeoPosition place = frame.geo_from_local(at_m);
        CHECK(std::abs(place.latitude_deg) <= 90.0);
        CHECK(std::abs(place.longitude_deg) <= 180.0);
    }
}
