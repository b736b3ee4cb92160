#include "models/heights/local_frame.h"
#include "sim/base/axes.h"
#include "sim/links/cigi_host.h"
#include "sim/links/udp_port.h"
#include "ui/flight/live_flight.h"
#include "ui/flight/sender.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <fmt/format.h>

using namespace octant;
using namespace octant::ui::flight;
namespace links = sim::links;
using sim::links::CigiAtmosphere;
using sim::links::CigiCelestial;
using ui::flight::air_from_cigi;

namespace {

/// Level ground at 0 m, 2,000 km wide, without a place.
ui::world::World level_world() {
    ui::world::World world;
    world.scene.ground = visuals::landscape::make_polygon_ground({}, {});
    return world;
}

/// The same on a map of UTM about 49.3 N, 123.1 W.
ui::world::World world_on_utm() {
    ui::world::World world = level_world();
    world.ground.place = GeoPosition{49.3, -123.1};
    world.ground.frame = models::heights::frame_of_ground(
        models::heights::CoordinateSystem{"EPSG:32610", 492729.777625, 5460811.038490, 1.0}, world.ground.place);
    return world;
}

sim::links::Fix fix_at(double latitude_deg, double longitude_deg, double altitude_m) {
    sim::links::Fix fix;
    fix.latitude_deg = latitude_deg;
    fix.longitude_deg = longitude_deg;
    fix.altitude_m = altitude_m;
    return fix;
}

bool says(const LiveGeoreference& place, const std::string& text) {
    for (const std::string& line : place.lines()) {
        if (line.find(text) != std::string::npos) { return true; }
    }
    return false;
}

const sim::links::VehicleKey key{};

} // namespace

TEST_CASE("vehicles lie over a map where the map has their places, far from its middle too") {
    const ui::world::World world = world_on_utm();
    LiveGeoreference place(world, std::nullopt);
    const auto local = place.world_position(key, fix_at(49.0, -122.5, 900.0));
    CHECK(local.at_m.x == Approx(43841.420665).margin(1e-3));
    CHECK(local.at_m.y == Approx(-33234.825378).margin(1e-3));
    CHECK(local.at_m.z == 900.0);
    CHECK(local.north_bearing_rad == Approx(-0.006586).margin(1e-5));
}

TEST_CASE("over made ground a vehicle flies across the pole and the date line without a jump") {
    const ui::world::World world = level_world();
    LiveGeoreference place(world, LiveHeightMode::Msl);
    place.world_position(key, fix_at(89.99, 179.0, 900.0));
    const auto before = place.world_position(key, fix_at(89.9999, 180.0, 900.0));
    const auto behind = place.world_position(key, fix_at(89.9999, 0.0, 900.0));
    CHECK(glm::distance(before.at_m, behind.at_m) == Approx(22.34).margin(0.01));
    const auto west = place.world_position(key, fix_at(89.9, 179.999, 900.0));
    const auto east = place.world_position(key, fix_at(89.9, -179.999, 900.0));
    CHECK(glm::distance(west.at_m, east.at_m) < 1.0);
}

TEST_CASE("a vehicle that tells its height above where it started stands on made ground") {
    const ui::world::World world = level_world();
    LiveGeoreference place(world, std::nullopt);
    sim::links::Fix fix = fix_at(-35.36, 149.16, 584.0);
    fix.above_home_m = 0.0;
    CHECK(place.world_position(key, fix).at_m.z == Approx(0.0).margin(1e-9));
    fix.altitude_m = 684.0;
    fix.above_home_m = 100.0;
    CHECK(place.world_position(key, fix).at_m.z == Approx(100.0));
}

TEST_CASE("grounds that differ by more than five metres are told with numbers") {
    const ui::world::World world = world_on_utm();
    LiveGeoreference place(world, std::nullopt);
    sim::links::Fix fix = fix_at(49.3, -123.1, 104.9);
    fix.above_ground_m = 100.0;
    place.world_position(key, fix);
    CHECK_FALSE(says(place, "grounds differ"));
    fix.above_ground_m = 99.8;
    place.world_position(key, fix);
    CHECK(says(place, "grounds differ by -5.1 m: theirs 5.1 m, ours 0.0 m"));
    fix.above_ground_m.reset();
    fix.above_home_m = 0.0; // it stands where it started
    fix.altitude_m = 40.0;
    place.world_position(key, fix);
    CHECK(says(place, "grounds differ by -40.0 m: theirs 40.0 m, ours 0.0 m"));
}

TEST_CASE("a vehicle under the ground is told, by how much") {
    const ui::world::World world = world_on_utm();
    LiveGeoreference place(world, std::nullopt);
    place.world_position(key, fix_at(49.3, -123.1, -4.0));
    CHECK_FALSE(says(place, "under our ground"));
    place.world_position(key, fix_at(49.3, -123.1, -31.5));
    CHECK(says(place, "31.5 m under our ground"));
}

TEST_CASE("who asks for heights above ground is told where a sender has none") {
    const ui::world::World world = world_on_utm();
    LiveGeoreference place(world, LiveHeightMode::Agl);
    sim::links::Fix fix = fix_at(49.3, -123.1, 104.9);
    CHECK(place.world_position(key, fix).at_m.z == 104.9);
    CHECK(says(place, "--height agl: the sender tells no height above ground"));
    fix.above_ground_m = 12.0;
    CHECK(place.world_position(key, fix).at_m.z == 12.0);
    CHECK_FALSE(says(place, "--height agl"));
}

TEST_CASE("a vehicle begins as high over made ground as it says when it moves, not while it loads") {
    const ui::world::World world = level_world();
    LiveGeoreference place(world, std::nullopt);
    sim::links::Fix fix = fix_at(64.1, -21.9, 914.4); // as FlightGear has it
    fix.above_ground_m = 0.0;
    CHECK(place.world_position(key, fix).at_m.z == Approx(0.0).margin(1e-9));
    double height_m = 0.0;
    for (int i = 1; i < 10; ++i) {
        fix.latitude_deg += 1e-5;
        fix.above_ground_m = i == 1 ? 0.0 : 900.0;
        height_m = place.world_position(key, fix).at_m.z;
    }
    CHECK(height_m == Approx(900.0));
    fix.altitude_m -= 50.0;
    fix.above_ground_m = 700.0; // over higher ground of theirs
    CHECK(place.world_position(key, fix).at_m.z == Approx(850.0));
    fix.latitude_deg += 1.0; // it is put elsewhere
    fix.above_ground_m = 300.0;
    CHECK(place.world_position(key, fix).at_m.z == Approx(300.0));
}

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

TEST_CASE("a host does what else there is to do while it waits for an image generator") {
    constexpr std::uint32_t loopback = 0x7f000001;
    links::UdpPort generator(loopback, 0);
    const std::uint16_t own = links::UdpPort(loopback, 0).port();
    ui::flight::CigiChannels channels;
    channels.add(fmt::format("cigi:127.0.0.1:{}:{}", generator.port(), own));
    int done = 0;
    const auto unanswered = channels.wait_for_first_frames([&] {
        if (++done == 10) {
            links::WireWriter start(links::ByteOrder::Big);
            links::add_start_of_frame(start, {});
            generator.send({loopback, own}, start.bytes());
        }
    });
    CHECK(unanswered.empty());
    CHECK(done >= 10);
}
