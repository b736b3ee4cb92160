#include "sim/sun_position.h"

#include <catch2/catch.hpp>

using namespace octant;

namespace {

constexpr double equinox = 81.0; ///< declination 0 in Cooper's equation
constexpr double midsummer = 172.0;

} // namespace

TEST_CASE("at the equinox the sun rises in the east at six and is highest in the south at noon") {
    const sim::SunPosition rise = sim::sun_position(45.0, equinox, 6.0);
    CHECK(rise.azimuth_deg == Approx(90.0));
    CHECK(rise.elevation_deg == Approx(0.0).margin(1e-9));
    const sim::SunPosition noon = sim::sun_position(45.0, equinox, 12.0);
    CHECK(noon.azimuth_deg == Approx(180.0));
    CHECK(noon.elevation_deg == Approx(45.0));
    CHECK(sim::sun_position(45.0, equinox, 18.0).azimuth_deg == Approx(270.0));
}

TEST_CASE("at midsummer the noon sun stands the obliquity higher, and in the south lower") {
    CHECK(sim::sun_position(45.0, midsummer, 12.0).elevation_deg == Approx(45.0 + 23.45).margin(0.01));
    const sim::SunPosition south = sim::sun_position(-45.0, midsummer, 12.0);
    CHECK(south.elevation_deg == Approx(45.0 - 23.45).margin(0.01));
    const bool in_the_north = south.azimuth_deg < 1e-6 || south.azimuth_deg > 360.0 - 1e-6;
    CHECK(in_the_north);
}

TEST_CASE("the sun is below the horizon at night, but not beyond the polar circle in summer") {
    CHECK(sim::sun_position(45.0, midsummer, 0.0).elevation_deg < -20.0);
    CHECK(sim::sun_position(70.0, midsummer, 0.0).elevation_deg > 3.0);
}

TEST_CASE("a time of day and year is read, and what no calendar has is not") {
    const auto time = sim::solar_time_from_text("2024-02-29T17:05");
    REQUIRE(time);
    CHECK(*time == sim::SolarTime{2024, 2, 29, 17 * 60 + 5});
    CHECK(sim::day_of_year(*time) == 60);
    for (const char* const wrong : {"2023-02-29T17:05", "2024-13-01T00:00", "2024-00-01T00:00", "2024-04-31T00:00",
             "2024-04-30T24:00", "2024-04-30T23:60", "2024-04-30 23:50", "2024-4-30T23:50", "2024-04-30T23:5",
             "2024-04-30T+3:50", "2024-04-30T23:50Z", ""}) {
        INFO(wrong);
        CHECK_FALSE(sim::solar_time_from_text(wrong));
    }
}

TEST_CASE("every day of a year is found again by its number") {
    for (const int year : {2023, 2024}) {
        for (int day = 1; day <= 365; ++day) { CHECK(sim::day_of_year(sim::on_day({year, 7, 4, 30}, day)) == day); }
    }
}
