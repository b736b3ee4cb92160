#include "flightpaths/fly_script.h"
#include "flightpaths/placement.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "sim/flight_steps.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

#include "scratch.h"

using namespace octant;
using namespace octant::flightpaths;
using octant::sim::HeightMode;
using octant::tests::shipped;

namespace {

sim::AircraftLimits f15() { return sim::aircraft_kind("f15").limits; }

GroundHeight flat(double height_m) {
    return [height_m](double, double) { return height_m; };
}

/// Rolling ground on a square map.
GroundHeight hills(double height_m, double wave_m, double half_map_m = 1e6) {
    return [=](double x, double y) -> std::optional<double> {
        if (std::abs(x) > half_map_m || std::abs(y) > half_map_m) { return std::nullopt; }
        return height_m * (1.0 + std::sin(2 * pi * x / wave_m) * std::cos(2 * pi * y / wave_m));
    };
}

/// Straight north along x = 100, 50 m up.
sim::Trajectory northward(double speed_mps = 100, int duration_s = 20) {
    std::vector<sim::AircraftState> samples;
    for (int i = 0; i <= 20 * duration_s; ++i) {
        samples.push_back(
            {0.05 * i, {100, 0.05 * speed_mps * i, 50}, {0, speed_mps, 0}, body_to_world_from_euler({}), 1.0});
    }
    return sim::Trajectory(samples);
}

FlownPath flown_script(const std::string& name) {
    const PathScript script = read_path_script(shipped(name));
    return fly(script, sim::aircraft_kind(script.aircraft), false);
}

double lowest_clearance_m(const sim::Trajectory& path, const GroundHeight& ground) {
    double lowest = 1e9;
    for (double time_s = path.start_s(); time_s <= path.end_s(); time_s += 1.0 / 480) {
        const glm::dvec3 at = path.state_at(time_s).position_m;
        lowest = std::min(lowest, at.z - *ground(at.x, at.y));
    }
    return lowest;
}

} // namespace

TEST_CASE("a path is turned clockwise about its origin and moved") {
    const PlacedPath placed =
        place_over_ground(northward(), {{1000, 2000}, pi / 2, HeightMode::Datum}, flat(0), 0, f15());
    const sim::AircraftState& first = placed.trajectory.samples().front();
    const sim::AircraftState& last = placed.trajectory.samples().back();
    CHECK(first.position_m.x == Approx(1000));
    CHECK(first.position_m.y == Approx(1900));
    CHECK(last.position_m.x == Approx(3000));
    CHECK(last.velocity_mps.x == Approx(100));
    CHECK(euler_from_body_to_world(last.body_to_world).heading_rad == Approx(pi / 2));
    CHECK(placed.offset_m == 0.0);
    CHECK(placed.lowest_clearance_m == Approx(50));
}

TEST_CASE("clear lifts or lowers the whole path to its lowest clearance, and no more") {
    const PlacedPath over = place_over_ground(northward(), {{0, 0}, 0.0, HeightMode::Clear}, flat(700), 30, f15());
    CHECK(over.offset_m == Approx(680));
    CHECK(over.lowest_clearance_m == Approx(30));
    CHECK(over.trajectory.samples()[7].position_m.z == Approx(730));
    const GroundHeight ground = hills(300, 4000);
    const sim::Trajectory path = flown_script("f15-pop-up").trajectory;
    const PlacedPath placed = place_over_ground(path, {{500, -700}, 1.0, HeightMode::Clear}, ground, 60, f15());
    CHECK(placed.lowest_clearance_m == Approx(60).margin(1e-9));
    CHECK(lowest_clearance_m(placed.trajectory, ground) == Approx(60).margin(0.01));
    for (std::size_t i = 0; i < path.samples().size(); ++i) {
        CHECK(placed.trajectory.samples()[i].position_m.z - path.samples()[i].position_m.z == Approx(placed.offset_m));
    }
    const glm::dvec3 at = placed.trajectory.state_at(placed.lowest_clearance_at_s).position_m;
    CHECK(at.z - *ground(at.x, at.y) == Approx(60).margin(1e-6));
}

TEST_CASE("without a heading the one with the least relief is taken, the lowest among equals") {
    const PlacedPath even =
        place_over_ground(northward(), {{0, 0}, std::nullopt, HeightMode::Clear}, flat(0), 30, f15());
    CHECK(even.heading_rad == 0.0);
    // A slope that rises to the north: east and west are the level ways.
    const GroundHeight slope = [](double, double y) { return 0.1 * y; };
    const PlacedPath placed =
        place_over_ground(northward(), {{0, 0}, std::nullopt, HeightMode::Clear}, slope, 30, f15());
    CHECK(deg_from_rad(placed.heading_rad) == Approx(90));
}

TEST_CASE("headings that leave the map are passed over, then the middle of the path is tried") {
    const auto strip = [](double min_y) -> GroundHeight {
        return [=](double x, double y) -> std::optional<double> {
            if (std::abs(x) > 250 || y < min_y || y > min_y + 2500) { return std::nullopt; }
            return 10.0;
        };
    };
    const PlacementOptions here{{0, 0}, std::nullopt, HeightMode::Clear};
    CHECK(place_over_ground(northward(), here, strip(-100), 30, f15()).heading_rad == 0.0);
    CHECK(deg_from_rad(place_over_ground(northward(), here, strip(-2300), 30, f15()).heading_rad) == Approx(180));
    const PlacedPath middle = place_over_ground(northward(), here, strip(-1200), 30, f15());
    CHECK(middle.heading_rad == 0.0);
    CHECK(middle.origin_m.x == Approx(-100));
    CHECK(middle.origin_m.y == Approx(-1000));
}

TEST_CASE("a path that leaves the map is refused with time and place") {
    const GroundHeight small = hills(0, 1000, 1500);
    CHECK_THROWS_WITH(place_over_ground(northward(), {{0, 0}, 0.0, HeightMode::Clear}, small, 30, f15()),
        "path leaves the map at t = 15.0 s, x = 100.0, y = 1500.8 m");
    CHECK_THROWS_WITH(
        place_over_ground(northward(), {{1400, 0}, std::nullopt, HeightMode::Clear}, hills(0, 1000, 90), 30, f15()),
        "path leaves the map at every heading, with heading 0 at t = 0.0 s, x = 1500.0, y = 0.0 m");
    const GroundHeight hole = [](double, double y) {
        return y > 500 ? std::optional<double>(std::nan("")) : std::optional<double>(0.0);
    };
    CHECK_THROWS_AS(place_over_ground(northward(), {{0, 0}, 0.0, HeightMode::Follow}, hole, 30, f15()), Error);
}

TEST_CASE("at datum heights a path that meets the ground is refused with time and place") {
    const GroundHeight slope = [](double, double y) { return 0.1 * y; };
    CHECK_THROWS_WITH(place_over_ground(northward(), {{0, 0}, 0.0, HeightMode::Datum}, slope, 30, f15()),
        "path meets the ground at t = 5.0 s, x = 100.0, y = 500.0 m, and is 150.0 m below it at "
        "its lowest");
}

TEST_CASE("a path that meets the ground is refused in every mode") {
    const sim::Trajectory path = northward();
    const std::string start = "path meets the ground at t = 0.0 s, x = 100.0, y = 0.0 m, and is ";
    for (const double height_m : {0.0, 700.0}) {
        CHECK_THROWS_WITH(place_over_ground(path, {{0, 0}, 0.0, HeightMode::Clear}, flat(height_m), 0, f15()),
            start + "0.0 m below it at its lowest");
    }
    CHECK_THROWS_WITH(place_over_ground(path, {{0, 0}, 0.0, HeightMode::Clear}, flat(0), -30, f15()),
        start + "30.0 m below it at its lowest");
    std::vector<sim::AircraftState> low(path.samples().begin(), path.samples().end());
    for (sim::AircraftState& state : low) { state.position_m.z = 0.0; }
    CHECK_THROWS_WITH(place_over_ground(sim::Trajectory(low), {{0, 0}, 0.0, HeightMode::Follow}, flat(120), 0, f15()),
        start + "0.0 m below it at its lowest");
    CHECK_NOTHROW(place_over_ground(path, {{0, 0}, 0.0, HeightMode::Clear}, flat(700), 1, f15()));
}

TEST_CASE("a path in world axes is looked at where it is") {
    const sim::Trajectory path = northward();
    CHECK_NOTHROW(check_over_ground(path, flat(49.9)));
    CHECK_THROWS_WITH(check_over_ground(path, flat(50)),
        "path meets the ground at t = 0.0 s, x = 100.0, y = 0.0 m, and is 0.0 m below it at its "
        "lowest");
    CHECK_THROWS_WITH(check_over_ground(path, [](double, double y) { return 0.1 * y; }),
        "path meets the ground at t = 5.0 s, x = 100.0, y = 500.0 m, and is 150.0 m below it at "
        "its lowest");
    CHECK_THROWS_WITH(
        check_over_ground(path, hills(0, 1000, 1500)), "path leaves the map at t = 15.0 s, x = 100.0, y = 1500.8 m");
}

TEST_CASE("what place_over_ground has placed passes the look at it") {
    const GroundHeight ground = hills(300, 4000);
    for (const HeightMode mode : {HeightMode::Clear, HeightMode::Follow}) {
        const PlacedPath placed = place_over_ground(northward(), {{500, -700}, 1.0, mode}, ground, 1, f15());
        CHECK_NOTHROW(check_over_ground(placed.trajectory, ground));
    }
}

TEST_CASE("slopes are limited to the smallest curve above") {
    const std::vector<double> up(7, 1.0);
    const std::vector<double> down(7, 2.0);
    CHECK(slope_limited({0, 0, 0, 5, 0, 0, 0}, up, down) == std::vector<double>{2, 3, 4, 5, 3, 1, 0});
}

TEST_CASE("following level ground adds its height and nothing else") {
    const PlacedPath placed = place_over_ground(northward(), {{0, 0}, 0.0, HeightMode::Follow}, flat(120), 30, f15());
    CHECK(placed.offset_m == Approx(120));
    CHECK(placed.notes.empty());
    for (const auto& state : placed.trajectory.samples()) {
        CHECK(state.position_m.z == Approx(170));
        CHECK(state.velocity_mps.z == Approx(0).margin(1e-9));
        CHECK(state.load_factor == Approx(1));
    }
}

TEST_CASE("following keeps clearance, climb and load factor and stays closer than a level lift") {
    for (const char* name : {"f15-straight", "f15-jinking", "f15-pop-up", "f15-turn", "500md-straight", "500md-jinking",
             "500md-pop-up", "500md-turn"}) {
        INFO(name);
        const PathScript script = read_path_script(shipped(name));
        const auto& kind = sim::aircraft_kind(script.aircraft);
        const sim::Trajectory path = fly(script, kind, false).trajectory;
        const GroundHeight ground = hills(script.aircraft == "f15" ? 200 : 15, 3000);
        const PlacedPath placed =
            place_over_ground(path, {{300, 200}, 0.5, HeightMode::Follow}, ground, script.min_clearance_m, kind.limits);
        double highest_ground_m = 0.0;
        for (const auto& state : placed.trajectory.samples()) {
            highest_ground_m = std::max(highest_ground_m, *ground(state.position_m.x, state.position_m.y));
        }
        CHECK(placed.lowest_clearance_m >= script.min_clearance_m - 1e-9);
        CHECK(lowest_clearance_m(placed.trajectory, ground) > script.min_clearance_m - 0.05);
        double sum_follow = 0.0;
        double sum_level = 0.0;
        for (std::size_t i = 0; i < path.samples().size(); ++i) {
            const sim::AircraftState& own = path.samples()[i];
            const sim::AircraftState& now = placed.trajectory.samples()[i];
            sum_follow += now.position_m.z;
            sum_level += own.position_m.z + highest_ground_m;
            CHECK(now.load_factor <= std::max(own.load_factor, kind.limits.max_load_factor) + 1e-6);
            CHECK(now.load_factor >= std::min(own.load_factor, kind.limits.min_load_factor) - 1e-6);
            const double added_mps = now.velocity_mps.z - own.velocity_mps.z;
            CHECK(std::abs(added_mps) <= 0.2501 * glm::length(own.velocity_mps));
            CHECK(added_mps <= kind.limits.climb_rate_mps + 1e-6);
            // The nose moves with the path: its angle to the velocity stays.
            const glm::dvec3 nose(1, 0, 0);
            CHECK(glm::dot(own.body_to_world * nose, glm::normalize(own.velocity_mps)) ==
                  Approx(glm::dot(now.body_to_world * nose, glm::normalize(now.velocity_mps))).margin(1e-9));
        }
        CHECK(sum_follow <= sum_level + 1e-3 * static_cast<double>(path.samples().size()));
    }
}

TEST_CASE("a followed path's velocity is the slope of its heights") {
    const sim::Trajectory path = flown_script("f15-straight").trajectory;
    const PlacedPath placed = place_over_ground(path, {{0, 0}, 0.3, HeightMode::Follow}, hills(150, 5000), 100, f15());
    const auto samples = placed.trajectory.samples();
    double max_mps = 0.0;
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
        const double slope_mps = (samples[i + 1].position_m.z - samples[i - 1].position_m.z) / 0.1;
        CHECK(samples[i].velocity_mps.z == Approx(slope_mps).margin(0.1));
        max_mps = std::max(max_mps, std::abs(slope_mps));
    }
    CHECK(max_mps > 5.0); // it does follow
    CHECK(placed.notes.empty());
}

TEST_CASE("steep ground is cleared even where it cannot be followed") {
    const GroundHeight wall = [](double, double y) { return y > 1000 && y < 1100 ? 600.0 : 0.0; };
    const PlacedPath placed =
        place_over_ground(northward(), {{0, 0}, 0.0, HeightMode::Follow}, wall, 30, sim::aircraft_kind("500md").limits);
    CHECK(placed.lowest_clearance_m >= 30 - 1e-9);
    CHECK(lowest_clearance_m(placed.trajectory, wall) >= 30 - 1e-6);
    CHECK(placed.notes.empty());
}

TEST_CASE("a path that is lifted by one height because it cannot follow says so") {
    sim::AircraftLimits gentle = f15();
    gentle.max_load_factor = 1.05;
    gentle.min_load_factor = 0.95;
    const auto check = [&](const sim::Trajectory& path, const GroundHeight& ground) {
        const PlacedPath placed = place_over_ground(path, {{0, 0}, 0.0, HeightMode::Follow}, ground, 30, gentle);
        CHECK(placed.offset_m == Approx(600));
        CHECK(placed.lowest_clearance_m == Approx(50));
        CHECK(placed.notes == std::vector<std::string>{
                                  "the ground is too steep to follow within the aircraft's limits: the whole path is "
                                  "lifted by 600.0 m"});
    };
    // No rounding fits over the wall; the first that fits the valley fills it to the brim.
    check(northward(200, 100), [](double, double y) { return y > 10000 && y < 10100 ? 600.0 : 0.0; });
    check(northward(), [](double, double y) { return y > 250 && y < 1750 ? 0.0 : 600.0; });
}
