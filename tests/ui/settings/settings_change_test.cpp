#include "ui/settings/settings_change.h"

#include <catch2/catch.hpp>

using namespace octant;
using ui::settings::change_between;
using ui::settings::RunSettings;
using ui::settings::SettingsChange;

TEST_CASE("a change of settings costs what has to be made anew for it") {
    const RunSettings before;
    CHECK(change_between(before, before) == SettingsChange::None);
    RunSettings after = before;
    after.time.rate_hz = 30.0;
    CHECK(change_between(before, after) == SettingsChange::Recording);
    after.view.azimuth_deg = 10.0;
    CHECK(change_between(before, after) == SettingsChange::Look);
    after.ground.triangles = 5000;
    CHECK(change_between(before, after) == SettingsChange::Picture);
    after.air.drape = "photo.tif";
    CHECK(change_between(before, after) == SettingsChange::World);
    after.path.aircraft.emplace_back("f15");
    CHECK(change_between(before, after) == SettingsChange::Flight);
}
