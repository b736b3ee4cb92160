#include "flightpaths/fly_script.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

#include "scratch.h"

using namespace octant;
using namespace octant::flightpaths;
using octant::tests::replaced;
using octant::tests::written;

namespace {

const std::string script_head = R"(aircraft = "test"
title = "Test"
rate_hz = 20
samples = 101
min_clearance_m = 50
[start]
north_m = 0
east_m = 0
height_m = 200
heading_deg = 0
speed_mps = 50
[[leg]]
)";

PathScript script_of(const std::string& legs, const std::string& speed_mps = "50") {
    const std::string start = replaced(script_head, "speed_mps = 50", "speed_mps = " + speed_mps);
    return read_path_script(written("legs.toml", start + legs));
}

FlownPath flown_legs(const std::string& legs, const std::string& aircraft = "500md", bool lenient = false) {
    return fly(script_of(legs), sim::aircraft_kind(aircraft), lenient);
}

std::string flight_fault(
    const std::string& legs, const std::string& aircraft = "500md", const std::string& speed_mps = "50") {
    const PathScript script = script_of(legs, speed_mps);
    try {
        fly(script, sim::aircraft_kind(aircraft), false);
    } catch (const Error& error) { return std::string(error.what()).substr(script.file.string().size() + 1); }
    return "no error";
}

/// The notes of a lenient flight without their path.
std::vector<std::string> notes_of(const std::string& legs) {
    const PathScript script = script_of(legs);
    std::vector<std::string> notes;
    for (const std::string& note : fly(script, sim::aircraft_kind("500md"), true).notes) {
        notes.push_back(note.substr(script.file.string().size() + 1));
    }
    return notes;
}

const sim::AircraftState& last(const FlownPath& path) { return path.trajectory.samples().back(); }

double climb_deg(const sim::AircraftState& state) {
    return deg_from_rad(std::asin(state.velocity_mps.z / glm::length(state.velocity_mps)));
}

double bank_deg(const sim::AircraftState& state) {
    return deg_from_rad(euler_from_body_to_world(state.body_to_world).roll_rad);
}

} // namespace

TEST_CASE("a straight leg flies straight, sampled evenly from 0 s") {
    const FlownPath path = flown_legs("fly = \"straight\"\nduration_s = 5\n");
    REQUIRE(path.trajectory.samples().size() == 101);
    CHECK(path.notes.empty());
    for (std::size_t i = 0; i < 101; ++i) {
        const sim::AircraftState& state = path.trajectory.samples()[i];
        CHECK(state.time_s == Approx(0.05 * static_cast<double>(i)));
        CHECK(state.position_m.y == Approx(2.5 * static_cast<double>(i)).margin(1e-9));
        CHECK(state.position_m.x == Approx(0).margin(1e-9));
        CHECK(state.position_m.z == Approx(200));
    }
}

TEST_CASE("legs end where they say") {
    PathScript pull = script_of("fly = \"pull\"\nload_factor_g = 3.5\nto_climb_deg = 30\n"
                                "[[leg]]\nfly = \"hold\"\nduration_s = 1.2\n",
        "250");
    pull.samples = 121;
    const FlownPath climb = fly(pull, sim::aircraft_kind("f15"), false);
    CHECK(climb_deg(last(climb)) == Approx(30).margin(1));
    // 2.5 g at first and, as the path steepens, up to 2.63 g bend the path.
    REQUIRE(climb.legs.size() == 2);
    CHECK(climb.legs[1].time_s == Approx(rad_from_deg(30) * 250 / (2.56 * gravity_mps2)).epsilon(0.03));
    const FlownPath turn = flown_legs("fly = \"turn\"\nside = \"right\"\nbank_deg = 40\nheading_change_deg = 30\n"
                                      "[[leg]]\nfly = \"straight\"\nduration_s = 2\n");
    CHECK(deg_from_rad(euler_from_body_to_world(last(turn).body_to_world).heading_rad) == Approx(30).margin(1));
    CHECK(bank_deg(last(turn)) == Approx(0).margin(1));
    CHECK(last(turn).position_m.z == Approx(200).margin(0.5));
    CHECK(climb_deg(last(flown_legs("fly = \"dive\"\ndive_deg = 12\nto_height_m = 187\n"
                                    "[[leg]]\nfly = \"straight\"\nduration_s = 4\n"))) == Approx(0).margin(1.5));
}

TEST_CASE("a turn given by its load factor banks as that asks") {
    const FlownPath path = flown_legs("fly = \"turn\"\nside = \"left\"\nload_factor_g = 1.41421356\nduration_s = 5\n");
    CHECK(bank_deg(last(path)) == Approx(-45).margin(0.2));
    CHECK(last(path).load_factor == Approx(1.414).epsilon(0.01));
}

TEST_CASE("speed changes evenly and stops where it should") {
    const FlownPath path =
        flown_legs("fly = \"straight\"\nduration_s = 5\nacceleration_mps2 = -2\nto_speed_mps = 46\n");
    CHECK(glm::length(path.trajectory.state_at(1.0).velocity_mps) == Approx(48));
    CHECK(glm::length(last(path).velocity_mps) == Approx(46).margin(0.05));
}

TEST_CASE("a weave stays centred on its line") {
    PathScript script =
        script_of("fly = \"jink\"\nlateral_g = 0.7\nperiod_s = 9\nvertical_g = 0.2\nvertical_period_s = "
                  "6\nduration_s = 45\n");
    script.samples = 901;
    const FlownPath path = fly(script, sim::aircraft_kind("500md"), false);
    double most = 0.0;
    double least = 0.0;
    for (const auto& state : path.trajectory.samples()) {
        most = std::max(most, state.position_m.x);
        least = std::min(least, state.position_m.x);
    }
    // Amplitude a / w^2, w = 2 pi / T.
    const double amplitude = 0.7 * gravity_mps2 * 81 / (4 * pi * pi);
    CHECK(most == Approx(amplitude).epsilon(0.1));
    CHECK(least == Approx(-amplitude).epsilon(0.1));
    CHECK(last(path).position_m.z == Approx(200).margin(2));
}

TEST_CASE("a leg beyond the aircraft is refused with its line") {
    CHECK(flight_fault("fly = \"pull\"\nload_factor_g = 3.5\nto_climb_deg = 10\n") ==
          "12: expected a load factor of at most 2.0 for 500md, got 3.5");
    CHECK(flight_fault("fly = \"push\"\nload_factor_g = 0.1\nto_climb_deg = -10\n") ==
          "12: expected a load factor of at least 0.3 for 500md, got 0.1");
    CHECK(flight_fault("fly = \"turn\"\nside = \"left\"\nbank_deg = 70\nduration_s = 5\n") ==
          "12: expected a bank of at most 60.0 deg for 500md, got 70.0");
    CHECK(flight_fault("fly = \"turn\"\nside = \"left\"\nbank_deg = 84\nduration_s = 5\n", "f15", "250") ==
          "12: expected a bank of at most 82.16 deg for f15, got 84.0");
    CHECK(flight_fault("fly = \"straight\"\nduration_s = 5\nroll_rate_degps = 90\n") ==
          "12: expected a roll rate of at most 60.0 deg/s for 500md, got 90.0");
    CHECK(flight_fault("fly = \"straight\"\nduration_s = 5\nacceleration_mps2 = -5\n") ==
          "12: expected a change of speed of at most 3.0 m/s2 for 500md, got 5.0");
    CHECK(flight_fault("fly = \"straight\"\nduration_s = 5\nacceleration_mps2 = 2\nto_speed_mps = 90\n") ==
          "12: expected a speed of at most 78.2 m/s for 500md, got 90.0");
    CHECK(flight_fault("fly = \"climb\"\nclimb_deg = 18\nduration_s = 5\n") ==
          "12: expected a sustained climb rate of at most 8.6 m/s for 500md, got 15.45");
    CHECK(flight_fault("fly = \"jink\"\nlateral_g = 1.8\nperiod_s = 9\nduration_s = 30\n") ==
          "12: expected a weave with a load factor of at most 2.0 for 500md, got 2.06");
    CHECK(flight_fault("fly = \"jink\"\nlateral_g = 0.9\nperiod_s = 4\nduration_s = 30\n") ==
          "12: expected a weave with a roll rate in deg/s of at most 60.0 for 500md, got 80.99");
    CHECK(flight_fault("fly = \"straight\"\nduration_s = 5\n", "f15") ==
          "6: expected a starting speed of at least 80.0 m/s for f15, got 50.0");
}

TEST_CASE("a lenient flight clips and says so") {
    CHECK(notes_of("fly = \"pull\"\nload_factor_g = 3.5\nto_climb_deg = 8\n"
                   "[[leg]]\nfly = \"straight\"\nduration_s = 4\n") ==
          std::vector<std::string>{"12: load factor of 3.5 clipped to 2.0, the most for 500md"});
    const FlownPath climb = flown_legs("fly = \"climb\"\nclimb_deg = 18\nduration_s = 5\n", "500md", true);
    REQUIRE(climb.notes.size() == 1);
    CHECK_THAT(
        climb.notes[0], Catch::EndsWith("12: sustained climb rate of 15.45 m/s clipped to 8.6, the most for 500md"));
    // What the climb gains beyond 8.6 m/s comes out of the speed.
    const double gained = last(climb).position_m.z - 200;
    const double speed = glm::length(last(climb).velocity_mps);
    CHECK(gained + speed * speed / (2 * gravity_mps2) <= 50 * 50 / (2 * gravity_mps2) + 5 * 8.6);
    CHECK(speed < 49);
    CHECK(notes_of("fly = \"jink\"\nlateral_g = 1.8\nperiod_s = 9\nduration_s = 30\n") ==
          std::vector<std::string>{"12: weave clipped to 83 %: expected a weave with a load factor of at most 2.0 for "
                                   "500md, got 2.06"});
    const FlownPath turn =
        flown_legs("fly = \"turn\"\nside = \"left\"\nbank_deg = 80\nduration_s = 5\n", "500md", true);
    for (const auto& state : turn.trajectory.samples()) {
        CHECK(std::abs(bank_deg(state)) < 60.5);
        CHECK(state.load_factor <= 2.0 + 1e-9);
    }
}

TEST_CASE("legs that are too short are refused, a little too short held on, too long cut") {
    CHECK(flight_fault("fly = \"straight\"\nduration_s = 3\n") ==
          "12: expected legs for 5.00 s (101 samples), got 3.00 s");
    const FlownPath held = flown_legs("fly = \"turn\"\nside = \"left\"\nbank_deg = 30\nduration_s = 4.2\n");
    CHECK(bank_deg(last(held)) == Approx(-30).margin(0.1));
    const FlownPath cut =
        flown_legs("fly = \"straight\"\nduration_s = 9\n[[leg]]\nfly = \"straight\"\nduration_s = 1\n");
    CHECK(last(cut).time_s == 5.0);
    REQUIRE(cut.notes.size() == 1);
    CHECK_THAT(cut.notes[0], Catch::EndsWith(":15: the last sample comes before this leg"));
    CHECK(cut.legs.size() == 1);
}

TEST_CASE("a leg that cannot reach its end is refused") {
    CHECK(flight_fault("fly = \"climb\"\nclimb_deg = 5\nto_height_m = 100\n") ==
          "12: expected to_height above the 200.0 m where the climb begins, got 100.0 m");
    PathScript script = script_of("fly = \"pull\"\nload_factor_g = 1.05\nto_climb_deg = 40\nbank_deg = 50\n");
    script.samples = 1600;
    CHECK_THROWS_WITH(fly(script, sim::aircraft_kind("f15"), true),
        Catch::Contains("expected a pull that reaches 40.0 deg within 60 s, got "));
}
