#include "flightpaths/ground_contact.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "tests/scratch.h"
#include "ui/world/track_facts.h"
#include "ui/world/world.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

using namespace octant;
using ui::settings::RunSettings;
using ui::world::World;

namespace {

std::string track_file(const std::string& name) {
    return std::string(OCTANT_SOURCE_DIR) + "/tests/flightpaths/tracks/" + name;
}

/// A map of 17 by 8 km in UTM zone 10 around 49.2 N, 123.25 W: a plain at 5 m that rises to a hill of 60 m in the
/// south.
std::string plain() {
    const std::filesystem::path file = tests::scratch_folder() / "plain.asc";
    std::ofstream out(file);
    constexpr int columns = 171;
    constexpr int rows = 81;
    out << "ncols " << columns << "\nnrows " << rows << "\nxllcorner 472000\nyllcorner 5445000\ncellsize 100\n";
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) { out << (row > 70 ? 5.0 * (row - 70) + 5.0 : 5.0) << ' '; }
        out << '\n';
    }
    return file.string();
}

RunSettings over_plain(const std::string& track) {
    RunSettings settings;
    settings.path.name = track;
    settings.path.terrain = plain();
    settings.path.terrain_system = "EPSG:32610";
    return settings;
}

bool has_note(const World& world, const std::string& text) {
    return std::ranges::any_of(
        world.notes, [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

double clearance_m(const World& world, double time_s) {
    const glm::dvec3 place_m = world.flight.trajectory.state_at(time_s).position_m;
    return place_m.z - world.scene.ground->height_at(place_m.x, place_m.y).value();
}

} // namespace

TEST_CASE("a landing that was recorded 12 m below the ground in coarse heights ends on the ground, without a jump") {
    const World world = load_world(over_plain(track_file("landing-25ft.csv")));
    const sim::Trajectory& path = world.flight.trajectory;
    double least_m = 1e9;
    for (double time_s = path.start_s(); time_s <= path.end_s(); time_s += 0.05) {
        least_m = std::min(least_m, clearance_m(world, time_s));
    }
    CHECK(least_m > 0.0);
    const double stands_m = clearance_m(world, path.end_s());
    CHECK(stands_m < 5.0);
    // The file says that it is on the ground from 155 s on.
    for (const double time_s : {156.0, 170.0, 190.0}) {
        CHECK(clearance_m(world, time_s) == Approx(stands_m).margin(0.05));
    }
    CHECK(clearance_m(world, 100.0) > 150.0);
    for (double time_s = path.start_s(); time_s + 1.0 <= path.end_s(); time_s += 0.5) {
        CHECK(std::abs(path.state_at(time_s + 1.0).position_m.z - path.state_at(time_s).position_m.z) < 8.0);
    }
    CHECK(std::abs(path.state_at(155.5).velocity_mps.z) < 1.0);
    CHECK(has_note(world, "laid onto the ground"));
    REQUIRE(world.flight.ground_contacts.size() == 1);
    REQUIRE(world.flight.ground_contacts[0].contacts.size() == 1);
    CHECK(world.flight.ground_contacts[0].contacts[0].added_from_m == Approx(12.6 + stands_m).margin(2.0));
    const ui::world::NamedTexts facts =
        ui::world::track_facts(*world.flight.recording, world.flight.inferences, world.flight.ground_contacts);
    CHECK_THAT(facts.back().second, Catch::Contains("; velocity measured; ") &&
                                        Catch::Contains("; on the ground 155 s to 195 s, heights changed by +") &&
                                        Catch::Contains("; phases flight from 0 s, landing run from 155 s; "));
}

TEST_CASE("what was done to lay a track on the ground is told with its altimeter settings") {
    CHECK(ui::world::contact_facts({}).empty());
    const flightpaths::GroundContactReport report{.contacts = {{0.0, 60.0, 80.0, 81.0}, {900.0, 960.0, 78.0, 77.5}},
        .qnh_take_off_hpa = 1022.96,
        .qnh_landing_hpa = 1022.5,
        .lifted_m = 2.0};
    CHECK(ui::world::text_of_facts(ui::world::contact_facts(report)) ==
          "on the ground 0 s to 60 s, heights changed by +80.0 to +81.0 m; 900 s to 960 s, heights changed by +78.0 to "
          "+77.5 m; altimeter setting at take-off 1023.0 hPa; altimeter setting at landing 1022.5 hPa; lifted over the "
          "ground 2.0 m");
}

TEST_CASE("of a track that begins off the map only what is flown must touch it, and --over-map finds that part") {
    const std::filesystem::path file = tests::scratch_folder() / "crossing.csv";
    {
        // To the west at about 73 m/s along 49.2 N, from 30 km east of the map.
        std::ofstream out(file);
        out << "Time (s),Latitude (deg),Longitude (deg),Altitude (m)\n";
        for (int i = 0; i < 160; ++i) { out << 5 * i << ",49.2," << -122.75 - 0.005 * i << ",800\n"; }
    }
    RunSettings settings = over_plain(file.string());
    CHECK_THROWS_WITH(load_world(settings), Catch::Contains("leaves the map") && Catch::Contains("--over-map"));
    settings.time.start_s = 450.0;
    settings.time.seconds = 100.0;
    CHECK_NOTHROW(load_world(settings));
    settings.time.seconds = 700.0;
    CHECK(has_note(load_world(settings), "no ground is known below: it is beside the map"));
    settings.time.start_s = 0.0;
    settings.time.seconds = 100.0;
    CHECK_THROWS_WITH(load_world(settings), Catch::Contains("path is beside the map"));
    settings.time = {};
    settings.path.over_map = true;
    const World world = load_world(settings);
    CHECK(has_note(world, "the part over the map is flown"));
    const sim::Trajectory& path = world.flight.trajectory;
    CHECK(path.end_s() - path.start_s() == Approx(17'000.0 / 73.0).margin(8.0));
    for (double time_s = path.start_s(); time_s <= path.end_s(); time_s += 1.0) {
        CHECK(clearance_m(world, time_s) > 700.0);
    }
    settings.path.name = "straight";
    CHECK_THROWS_WITH(
        load_world(settings), Catch::Contains("--over-map: expected a track with latitudes and longitudes"));
}

TEST_CASE("a parked aircraft stands on the ground, level as the ground is, and does not stir") {
    const std::filesystem::path file = tests::scratch_folder() / "stands.csv";
    {
        std::ofstream out(file);
        out << "Time (s),Latitude (deg),Longitude (deg),Altitude (m)\n";
        for (int i = 0; i < 60; ++i) {
            out << i << "," << 49.2 + 7e-6 * std::sin(3.1 * i) << "," << -123.25 + 1e-5 * std::cos(5.3 * i) << ","
                << 30.0 + std::sin(7.7 * i) << "\n";
        }
    }
    const World world = load_world(over_plain(file.string()));
    const sim::Trajectory& path = world.flight.trajectory;
    const double heading_rad = euler_from_body_to_world(path.state_at(0.0).body_to_world).heading_rad;
    for (double time_s = 0.0; time_s <= path.end_s(); time_s += 0.5) {
        const sim::AircraftState state = path.state_at(time_s);
        const EulerAngles angles = euler_from_body_to_world(state.body_to_world);
        CHECK(std::abs(deg_from_rad(angles.pitch_rad)) < 0.5);
        CHECK(std::abs(deg_from_rad(angles.roll_rad)) < 0.5);
        CHECK(angles.heading_rad == Approx(heading_rad).margin(1e-6));
        CHECK(glm::length(state.velocity_mps) < 0.1);
        CHECK(clearance_m(world, time_s) < 5.0);
        CHECK(clearance_m(world, time_s) > 0.0);
    }
}
