#include "ui/window/sun_position.h"

#include <catch2/catch.hpp>

using namespace octant;

namespace {

constexpr double equinox = 81.0; ///< declination 0 in Cooper's equation
constexpr double midsummer = 172.0;

} // namespace

TEST_CASE("at the equinox the sun rises in the east at six and is highest in the south at noon") {
    const ui::window::SunPosition rise = ui::window::sun_position(45.0, equinox, 6.0);
    CHECK(rise.azimuth_deg == Approx(90.0));
    CHECK(rise.elevation_deg == Approx(0.0).margin(1e-9));
    const ui::window::SunPosition noon = ui::window::sun_position(45.0, equinox, 12.0);
    CHECK(noon.azimuth_deg == Approx(180.0));
    CHECK(noon.elevation_deg == Approx(45.0));
    CHECK(ui::window::sun_position(45.0, equinox, 18.0).azimuth_deg == Approx(270.0));
}

TEST_CASE("at midsummer the noon sun stands the obliquity higher, and in the south lower") {
    CHECK(
        ui::window::sun_position(45.0, midsummer, 12.0).elevation_deg ==
        Approx(45.0 + 23.45).margin(0.01));
    const ui::window::SunPosition south = ui::window::sun_position(-45.0, midsummer, 12.0);
    CHECK(south.elevation_deg == Approx(45.0 - 23.45).margin(0.01));
    const bool in_the_north = south.azimuth_deg < 1e-6 || south.azimuth_deg > 360.0 - 1e-6;
    CHECK(in_the_north);
}

TEST_CASE("the sun is below the horizon at night, but not beyond the polar circle in summer") {
    CHECK(ui::window::sun_position(45.0, midsummer, 0.0).elevation_deg < -20.0);
    CHECK(ui::window::sun_position(70.0, midsummer, 0.0).elevation_deg > 3.0);
}
