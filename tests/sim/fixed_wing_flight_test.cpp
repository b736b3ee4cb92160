#include "sim/aircraft_kind.h"
#include "sim/flight_models.h"
#include "tests/sim/hand_flights.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace octant;
using namespace octant::tests;
using sim::PilotControls;
using sim::PilotedFlight;

TEST_CASE("an F-15 starts level on its heading with its nose a little up") {
    const auto state = sim::trimmed_state(sim::aircraft_kind("f15"), {1, 2, 3000}, rad_from_deg(90), 200);
    CHECK(state.velocity_mps.x == Approx(200));
    CHECK(state.velocity_mps.z == 0.0);
    CHECK(state.load_factor == 1.0);
    const EulerAngles angles = euler_from_body_to_world(state.body_to_world);
    CHECK(angles.heading_rad == Approx(rad_from_deg(90)));
    CHECK(deg_from_rad(angles.pitch_rad) == Approx(3.0).margin(1.5));
    CHECK(angles.roll_rad == Approx(0).margin(1e-12));
}

TEST_CASE("an F-15 in trim holds height, speed and attitude with the stick centred") {
    for (const double speed : {80.0, 150.0, 235.0, 300.0, 370.0}) {
        const auto flight = trimmed_f15(speed);
        const sim::AircraftState start = flight->state();
        CHECK(flight->trim_throttle() > 0.05);
        CHECK(flight->trim_throttle() < 0.95);
        hold(*flight, 30, {0, 0, 0, flight->trim_throttle()});
        CHECK(flight->state().position_m.z == Approx(1000).margin(0.5));
        CHECK(speed_mps(*flight) == Approx(speed).margin(0.1));
        CHECK(turn_radps(start.body_to_world, flight->state().body_to_world) < 1e-2);
        CHECK_FALSE(flight->warnings().stalled);
        CHECK_FALSE(flight->warnings().is_at_limit);
    }
}

TEST_CASE("a change of throttle changes the speed of an F-15 and not its height") {
    const auto flight = trimmed_f15(200);
    hold(*flight, 10, {0, 0, 0, 0.8});
    CHECK(speed_mps(*flight) > 240);
    hold(*flight, 30, {0, 0, 0, 0});
    CHECK(speed_mps(*flight) < 200);
    CHECK(flight->state().position_m.z == Approx(1000).margin(1));
}

TEST_CASE("a banked pull of 4 g turns an F-15 as its speed and load factor say") {
    const auto flight = trimmed_f15(235, 300);
    const double bank = std::acos(1.0 / 4.0);
    // A pilot who flies a bank and a load factor, with the throttle for the speed.
    const auto pilot = [&](double) {
        const double bank_error = wrapped_to_pi(bank - angles_of(*flight).roll_rad);
        const double level = flight->state().velocity_mps.z;
        return PilotControls{(4.0 - 0.05 * level - 1.0) / (7.33 - 1.0), std::clamp(1.0 * bank_error, -1.0, 1.0), 0.0,
            std::clamp(0.7 + 0.2 * (235.0 - speed_mps(*flight)), 0.0, 1.0)};
    };
    fly(*flight, 6, pilot, [](const PilotedFlight&) {});
    const double before = angles_of(*flight).heading_rad;
    double load_factor = 0.0;
    double speed = 0.0;
    fly(*flight, 5, pilot, [&](const PilotedFlight& f) {
        load_factor += f.state().load_factor / static_cast<double>(steps_of(5));
        speed += speed_mps(f) / static_cast<double>(steps_of(5));
    });
    const double turned = wrapped_to_two_pi(angles_of(*flight).heading_rad - before);
    CHECK(load_factor == Approx(4.0).margin(0.15));
    CHECK(speed == Approx(235).margin(6));
    CHECK(turned / 5.0 == Approx(gravity_mps2 * std::sqrt(load_factor * load_factor - 1.0) / speed).epsilon(0.03));
    CHECK(std::abs(flight->state().position_m.z - 300) < 100);
}

TEST_CASE("in a bank with the stick centred the nose of an F-15 drops") {
    const auto flight = trimmed_f15(235);
    fly(
        *flight, 5,
        [](double t) {
            return PilotControls{0, t < 0.5 ? 0.7 : 0.0, 0, 0.3};
        },
        [](const PilotedFlight&) {});
    CHECK(deg_from_rad(angles_of(*flight).roll_rad) > 30);
    CHECK(flight->state().velocity_mps.z < -10);
}

TEST_CASE("a stick at its stops never takes an F-15 beyond its load factors") {
    for (const double speed : {120.0, 200.0, 300.0, 380.0}) {
        for (const double stick : {1.0, -1.0}) {
            const auto flight = trimmed_f15(speed, 5000);
            double most = 1.0;
            double least = 1.0;
            double fastest = 0.0;
            double before = 1.0;
            fly(
                *flight, 20,
                [&](double) {
                    return PilotControls{stick, 0, 0, 1};
                },
                [&](const PilotedFlight& f) {
                    const double n = f.state().load_factor;
                    most = std::max(most, n);
                    least = std::min(least, n);
                    fastest = std::max(fastest, std::abs(n - before) * sim::steps_per_second);
                    before = n;
                });
            CHECK(most <= 7.33 + 1e-9);
            CHECK(least >= -3.0 - 1e-9);
            if (speed >= 300.0 && stick > 0.0) { CHECK(most > 7.2); }
            if (speed >= 200.0 && stick < 0.0) { CHECK(least < -2.9); }
            // What is faster than the pilot's rate is the wing that stalls.
            CHECK(fastest < 12.0);
        }
    }
}

TEST_CASE("the load factor of an F-15 comes on at no more than 6 g a second") {
    const auto flight = trimmed_f15(300, 3000);
    double before = 1.0;
    fly(
        *flight, 2,
        [](double t) {
            return PilotControls{t < 1.5 ? 1.0 : -1.0, 0, 0, 0.8};
        },
        [&](const PilotedFlight& f) {
            CHECK(std::abs(f.state().load_factor - before) * sim::steps_per_second < 6.1);
            before = f.state().load_factor;
        });
    CHECK(flight->warnings().is_at_limit == false);
    hold(*flight, 2, {1, 0, 0, 1});
    CHECK(flight->warnings().is_at_limit);
}

TEST_CASE("an F-15 flies Mach 1.1 to 1.25 low down, about Mach 2 high up, and no more") {
    const auto low = trimmed_f15(250, 0);
    hold(*low, 180, {0, 0, 0, 1});
    CHECK(speed_mps(*low) / 340.3 == Approx(1.15).margin(0.1));
    CHECK(std::abs(low->state().position_m.z) < 5);
    const auto high = trimmed_f15(280, 11000);
    hold(*high, 400, {0, 0, 0, 1});
    CHECK(speed_mps(*high) / 295.1 == Approx(2.0).margin(0.15));
    // Straight down with all there is: the drag wins.
    const auto down = trimmed_f15(300, 12000);
    hold(*down, 10, {-1, 0, 0, 1});
    hold(*down, 40, {0, 0, 0, 1});
    CHECK(down->state().velocity_mps.z < -200);
    CHECK(speed_mps(*down) < 700);
    CHECK(down->warnings().is_at_limit);
}

TEST_CASE("an F-15 climbs at the 50,000 ft/min of its data sheets") {
    const auto flight = trimmed_f15(290, 0);
    hold(*flight, 3, {0.8, 0, 0, 1});
    const double start_m = energy_height_m(*flight);
    hold(*flight, 5, {0, 0, 0, 1});
    const double climb_mps = (energy_height_m(*flight) - start_m) / 5.0;
    CHECK(climb_mps > m_from_ft(45000) / 60);
    CHECK(climb_mps < m_from_ft(70000) / 60);
}

TEST_CASE("an F-15 rolls at most at its limit, and the slower it flies the slower it rolls") {
    double before = 1e9;
    for (const double speed : {300.0, 200.0, 140.0, 90.0}) {
        const auto flight = trimmed_f15(speed, 3000);
        double fastest = 0.0;
        glm::dquat attitude = flight->state().body_to_world;
        fly(
            *flight, 2,
            [&](double) {
                return PilotControls{0, 1, 0, flight->trim_throttle()};
            },
            [&](const PilotedFlight& f) {
                fastest = std::max(fastest, turn_radps(attitude, f.state().body_to_world));
                attitude = f.state().body_to_world;
            });
        CHECK(flight->warnings().is_at_limit);
        CHECK(deg_from_rad(fastest) < 206);
        if (speed >= 200) {
            CHECK(deg_from_rad(fastest) > 195);
        } else {
            CHECK(fastest < 0.9 * before);
        }
        before = fastest;
    }
}

TEST_CASE("right is right: roll, turn and rudder of an F-15") {
    const auto rolled = trimmed_f15(235);
    hold(*rolled, 0.3, {0, 1, 0, 0.3});
    CHECK(angles_of(*rolled).roll_rad > 0.1);
    const auto yawed = trimmed_f15(235);
    hold(*yawed, 2, {0, 0, 1, 0.3});
    const double turned = wrapped_to_pi(angles_of(*yawed).heading_rad - rad_from_deg(70));
    CHECK(turned > rad_from_deg(4));
    const glm::dvec3 in_body = glm::conjugate(yawed->state().body_to_world) * yawed->state().velocity_mps;
    CHECK(in_body.y < 0);
    CHECK(std::abs(in_body.y) / speed_mps(*yawed) < std::sin(rad_from_deg(7)));
    hold(*yawed, 3, {0, 0, 0, 0.3});
    const glm::dvec3 after = glm::conjugate(yawed->state().body_to_world) * yawed->state().velocity_mps;
    CHECK(std::abs(after.y) < 0.2);
}

TEST_CASE("the throttle of an F-15 takes its time") {
    const auto flight = trimmed_f15(200);
    const double before = energy_height_m(*flight);
    hold(*flight, 0.2, {0, 0, 0, 1});
    const double first = energy_height_m(*flight) - before;
    hold(*flight, 5, {0, 0, 0, 1});
    const double later = energy_height_m(*flight);
    hold(*flight, 0.2, {0, 0, 0, 1});
    CHECK(first < 0.3 * (energy_height_m(*flight) - later));
}

TEST_CASE("without thrust the energy of an F-15 never rises") {
    const auto flight = trimmed_f15(380, 8000);
    hold(*flight, 8, {0, 0, 0, 0}); // the engines have run down
    // What is left of the engines' lag, and rounding.
    CHECK(largest_rise_without_throttle_m(*flight, 3, 120) < 1e-4);
}

TEST_CASE("a flight by hand takes an F-15 over as it is") {
    // In a turn to the left, nose along the velocity: what a written path may say.
    sim::AircraftState start;
    start.time_s = sim::time_of_step(777);
    start.position_m = {100, -200, 900};
    start.velocity_mps = {0, 235, 0};
    start.body_to_world = body_to_world_from_euler({0, 0, rad_from_deg(-75.5)});
    start.load_factor = 4.0;
    const auto flight = sim::make_piloted_flight(sim::aircraft_kind("f15"), start);
    CHECK(same_bits(flight->state(), start));
    glm::dquat attitude = start.body_to_world;
    double load_factor = 4.0;
    for (int i = 1; i <= 60; ++i) {
        flight->step({(4.0 - 1.0) / (7.33 - 1.0), 0, 0, flight->trim_throttle()});
        const sim::AircraftState& now = flight->state();
        CHECK(now.time_s == sim::time_of_step(777 + i));
        CHECK(turn_radps(attitude, now.body_to_world) < rad_from_deg(30));
        CHECK(now.load_factor == Approx(load_factor).margin(0.02));
        attitude = now.body_to_world;
        load_factor = now.load_factor;
    }
    CHECK(load_factor == Approx(4.0).margin(0.05));
}
