#include "ui/world/sun_at_time.h"

#include <catch2/catch.hpp>

using namespace octant;
using ui::settings::RunSettings;

TEST_CASE("a time sets the sun by the map's latitude, a night on the horizon with a note") {
    RunSettings settings;
    settings.air.time = "2024-06-21T12:00";
    const RunSettings north = ui::world::with_sun_at_time(settings, GeoPosition{60.0, 10.0});
    CHECK(north.air.sun_elevation_deg == Approx(90.0 - 60.0 + 23.45).margin(0.1));
    CHECK(north.air.sun_azimuth_deg == Approx(180.0));
    CHECK(ui::world::sun_notes(settings, GeoPosition{60.0, 10.0}).empty());
    CHECK(ui::world::sun_notes(settings, GeoPosition{60.0, 10.0, {3396190.0, 1.0 / 169.9}}) ==
          std::vector<std::string>{"--time 2024-06-21T12:00: the sun stands as over the earth at "
                                   "this latitude and date, not as over Mars"});
    const RunSettings nowhere = ui::world::with_sun_at_time(settings, {});
    CHECK(nowhere.air.sun_elevation_deg == Approx(45.0 + 23.45).margin(0.1));
    settings.air.time = "2024-12-21T00:00";
    CHECK(ui::world::with_sun_at_time(settings, {}).air.sun_elevation_deg == 0.0);
    CHECK(ui::world::sun_notes(settings, {}).size() == 1);
}

TEST_CASE("without a time the sun stays where it was put") {
    RunSettings settings;
    settings.air.sun_azimuth_deg = 12.0;
    CHECK(ui::world::with_sun_at_time(settings, GeoPosition{60.0, 10.0}) == settings);
}

TEST_CASE("a sun that is moved by hand has no time any more, and a new time moves it again") {
    RunSettings before;
    before.air.time = "2024-06-21T12:00";
    before = ui::world::with_sun_at_time(before, {});
    RunSettings moved = before;
    moved.air.sun_azimuth_deg = 90.0;
    const RunSettings by_hand = ui::world::with_sun_updated(moved, before, {});
    CHECK_FALSE(by_hand.air.time);
    CHECK(by_hand.air.sun_azimuth_deg == 90.0);
    RunSettings later = by_hand;
    later.air.time = "2024-06-21T18:00";
    const RunSettings evening = ui::world::with_sun_updated(later, by_hand, {});
    CHECK(evening.air.time);
    CHECK(evening.air.sun_azimuth_deg > 270.0);
    CHECK(ui::world::with_sun_updated(evening, evening, {}) == evening);
}
