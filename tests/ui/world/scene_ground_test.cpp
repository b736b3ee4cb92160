#include "models/procedural/procedural_terrain.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/world/user_cache.h"
#include "ui/world/scene_ground.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>

using namespace octant;
using namespace octant::ui::world;
namespace fs = std::filesystem;
using models::heights::HeightField;
using ui::settings::RunSettings;
using ui::world::built_in_ground;

namespace {

bool is_same(const HeightField& a, const HeightField& b) {
    bool same = a.columns() == b.columns() && a.rows() == b.rows() && a.spacing_m() == b.spacing_m() &&
                a.name == b.name && !a.place && !b.place && !a.system && !b.system &&
                a.filled_voids == b.filled_voids && a.lowest_m() == b.lowest_m() && a.highest_m() == b.highest_m();
    for (int row = 0; same && row < a.rows(); ++row) {
        for (int column = 0; column < a.columns(); ++column) {
            same = same && a.height_m(column, row) == b.height_m(column, row);
        }
    }
    return same;
}

} // namespace

TEST_CASE("built-in ground is the same made, read from the cache, and where the file is damaged") {
    const fs::path folder = tests::empty_folder("kept-ground");
    const tests::UserCache cache(folder);
    const fs::path file = folder / "octant" / "ground" / "hills.heights";
    const HeightField made = *models::procedural::procedural_terrain("hills");
    CHECK(is_same(*built_in_ground("hills"), made));
    REQUIRE(fs::exists(file));
    const std::string kept = read_file(file);
    CHECK(is_same(*built_in_ground("hills"), made));

    std::string damaged = kept;
    damaged[kept.size() / 2] = static_cast<char>(damaged[kept.size() / 2] ^ 1);
    std::string long_side = kept; // its checksum is wrong as well
    long_side[48] = '\x7f';
    for (const std::string& bytes : {damaged, long_side, kept.substr(0, kept.size() - 1)}) {
        write_file(file, bytes);
        CHECK(is_same(*built_in_ground("hills"), made));
        CHECK(read_file(file) == kept);
    }
}

TEST_CASE("built-in ground needs no cache, and other names are none") {
    const fs::path folder = tests::empty_folder("kept-ground-in-the-way");
    write_file(folder / "octant", "a file where the folder would be");
    const tests::UserCache cache(folder);
    CHECK(is_same(*built_in_ground("canyon"), *models::procedural::procedural_terrain("canyon")));
    CHECK_FALSE(built_in_ground("valley").has_value());
}

TEST_CASE("an eye point under the ground is told with one above it") {
    const auto note = low_eye_note({100.0, -200.0, 300.0}, 512.4);
    REQUIRE(note);
    CHECK(*note == "--eye 100,-200,300 lies 212.4 m under the ground, which is 512.4 m high there: "
                   "--eye 100,-200,515 lies above it");
    CHECK_FALSE(low_eye_note({100.0, -200.0, 512.5}, 512.4));
    CHECK_FALSE(low_eye_note({1e6, 0.0, -5.0}, std::nullopt)); // off the map
}

TEST_CASE("a map whose samples make too few triangles is told") {
    const auto note = few_samples_note("map.tif", {60, 60}, 20000, "--triangles with fewer");
    REQUIRE(note);
    CHECK(*note == "map.tif: 60 x 60 samples make at most 6962 triangles, and 20000 are asked for: "
                   "--triangles with fewer");
    CHECK_FALSE(few_samples_note("map.tif", {101, 101}, 20000, ""));
}

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
