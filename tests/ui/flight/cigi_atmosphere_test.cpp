#include "ui/flight/live_flight.h"

#include <catch2/catch.hpp>

using namespace octant;
using sim::links::CigiAtmosphere;
using sim::links::CigiCelestial;
using ui::flight::air_from_cigi;

TEST_CASE("a host's universal time is the sun's own at the place's longitude") {
    const auto time_at = [](double longitude_deg, const CigiCelestial& celestial) {
        return air_from_cigi({}, {}, celestial, GeoPosition{47.0, longitude_deg}).time;
    };
    CHECK(time_at(15.0, {true, 23, 30, 12312025}) == "2026-01-01T00:30");
    CHECK(time_at(-90.0, {true, 3, 0, 3012024}) == "2024-02-29T21:00");
    CHECK(time_at(0.0, {true, 12, 0, 6212026}) == "2026-06-21T12:00");
    CHECK_FALSE(time_at(0.0, {false, 12, 0, 6212026}));
    CHECK_FALSE(time_at(0.0, {true, 12, 0, 2302026}));
    CHECK_FALSE(time_at(0.0, {true, 12, 0, 4000000000U}));
}

TEST_CASE("a host's visibility is kept within what can be seen, and what it did not tell stays") {
    visuals::scene::AirSettings defaults;
    defaults.time = "2026-01-01T09:00";
    CHECK(air_from_cigi(defaults, CigiAtmosphere{true, 1500.0}, {}, {}).visibility_m == 1500.0);
    CHECK(air_from_cigi(defaults, CigiAtmosphere{true, 0.0}, {}, {}).visibility_m == 50.0);
    CHECK(air_from_cigi(defaults, CigiAtmosphere{true, 1e6}, {}, {}).visibility_m == 5e5);
    CHECK(air_from_cigi(defaults, {}, {}, {}) == defaults);
}
