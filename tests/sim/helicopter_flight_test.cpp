#include "sim/aircraft_kind.h"
#include "sim/flight_models.h"
#include "tests/sim/hand_flights.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <memory>

using namespace octant;
using namespace octant::tests;
using sim::PilotControls;
using sim::PilotedFlight;

namespace {

constexpr double heading = 0.8;

std::unique_ptr<PilotedFlight> trimmed(double speed_mps, double height_m = 300.0) {
    return sim::make_piloted_flight(sim::aircraft_kind("500md"),
        sim::trimmed_state(sim::aircraft_kind("500md"), {0, 0, height_m}, heading, speed_mps));
}

double ahead_mps(const PilotedFlight& flight) {
    return glm::dot(flight.state().velocity_mps, direction_from_heading(heading));
}

/// Flies level at full collective, as fast as it gets: cyclic for the height.
PilotControls level_flat_out(const PilotedFlight& flight) {
    const sim::AircraftState& state = flight.state();
    const double climb = state.velocity_mps.z + 0.2 * (state.position_m.z - 300.0);
    return {std::clamp(-0.1 * climb, -1.0, 1.0), 0, 0, 1};
}

} // namespace

TEST_CASE("a 500MD in trim holds height, speed and attitude with the cyclic centred") {
    for (const double speed : {0.0, 10.0, 30.0, 50.0, 70.0}) {
        const auto flight = trimmed(speed);
        const sim::AircraftState start = flight->state();
        CHECK(start.load_factor == 1.0);
        CHECK(flight->trim_throttle() > 0.3);
        CHECK(flight->trim_throttle() < 0.8);
        hold(*flight, 30, {0, 0, 0, flight->trim_throttle()});
        CHECK(flight->state().position_m.z == Approx(300).margin(0.5));
        CHECK(speed_mps(*flight) == Approx(speed).margin(0.1));
        CHECK(turn_radps(start.body_to_world, flight->state().body_to_world) < 1e-2);
        CHECK(flight->state().load_factor == Approx(1).margin(1e-3));
        CHECK_FALSE(flight->warnings().is_at_limit);
        CHECK_FALSE(flight->warnings().stalled);
    }
}

TEST_CASE("a pushed cyclic moves a hovering 500MD forward, a pulled one back, a centred one holds") {
    const auto flight = trimmed(0);
    const double trim = flight->trim_throttle();
    hold(*flight, 6, {-0.4, 0, 0, trim});
    CHECK(ahead_mps(*flight) > 5);
    CHECK(angles_of(*flight).pitch_rad < rad_from_deg(-5));
    hold(*flight, 1, {0, 0, 0, trim});
    const double speed = speed_mps(*flight);
    hold(*flight, 5, {0, 0, 0, trim});
    CHECK(ahead_mps(*flight) == Approx(speed).margin(1.5));
    hold(*flight, 12, {0.4, 0, 0, trim});
    CHECK(ahead_mps(*flight) < -2);
}

TEST_CASE("a 500MD left alone near the hover comes to a stop") {
    const auto flight = trimmed(0);
    const double trim = flight->trim_throttle();
    hold(*flight, 1.5, {-0.2, 0.2, 0, trim});
    CHECK(speed_mps(*flight) > 1);
    hold(*flight, 40, {0, 0, 0, trim});
    const glm::dvec3& velocity = flight->state().velocity_mps;
    CHECK(std::hypot(velocity.x, velocity.y) < 0.4);
}

TEST_CASE("cyclic to the side slides a hovering 500MD and turns a flying one") {
    const auto hovering = trimmed(0);
    hold(*hovering, 2, {0, 0.3, 0, hovering->trim_throttle()});
    const glm::dvec3 right(std::cos(heading), -std::sin(heading), 0.0);
    CHECK(glm::dot(hovering->state().velocity_mps, right) > 1);
    CHECK(wrapped_to_pi(angles_of(*hovering).heading_rad - heading) == Approx(0).margin(0.1));

    const auto flying = trimmed(40);
    const PilotControls turn{0, 0.75, 0, flying->trim_throttle() + 0.1};
    hold(*flying, 4, turn);
    CHECK(deg_from_rad(angles_of(*flying).roll_rad) == Approx(45).margin(1));
    const double before = angles_of(*flying).heading_rad;
    hold(*flying, 5, turn);
    const double rate = wrapped_to_two_pi(angles_of(*flying).heading_rad - before) / 5.0;
    CHECK(rate == Approx(gravity_mps2 * std::tan(rad_from_deg(45)) / 40.0).epsilon(0.06));
    // Nose along the path.
    const glm::dvec3 in_body = glm::conjugate(flying->state().body_to_world) * flying->state().velocity_mps;
    CHECK(std::abs(in_body.y) < 0.05 * speed_mps(*flying));
}

TEST_CASE("pedals turn a hovering 500MD on the spot and slip a flying one") {
    const auto hovering = trimmed(0);
    hold(*hovering, 3, {0, 0, 1, hovering->trim_throttle()});
    CHECK(wrapped_to_two_pi(angles_of(*hovering).heading_rad - heading) > rad_from_deg(90));
    CHECK(glm::length(hovering->state().position_m - glm::dvec3(0, 0, 300)) < 0.5);
    const auto flying = trimmed(50);
    hold(*flying, 4, {0, 0, 1, flying->trim_throttle()});
    const glm::dvec3 in_body = glm::conjugate(flying->state().body_to_world) * flying->state().velocity_mps;
    CHECK(in_body.y < -1);
    CHECK(in_body.y > -12);
}

TEST_CASE("bank, roll rate and load factor of a 500MD stay within its limits") {
    const auto flight = trimmed(40);
    double max_bank = 0.0;
    double max_load_factor = 0.0;
    double fastest = 0.0;
    glm::dquat attitude = flight->state().body_to_world;
    fly(
        *flight, 20,
        [](double t) {
            return PilotControls{0.3, std::fmod(t, 8.0) < 4.0 ? 1.0 : -1.0, 0, 1};
        },
        [&](const PilotedFlight& f) {
            max_bank = std::max(max_bank, std::abs(angles_of(f).roll_rad));
            max_load_factor = std::max(max_load_factor, f.state().load_factor);
            fastest = std::max(fastest, turn_radps(attitude, f.state().body_to_world));
            attitude = f.state().body_to_world;
        });
    CHECK(deg_from_rad(max_bank) == Approx(60).margin(0.5));
    CHECK(max_load_factor < 2.05);
    CHECK(deg_from_rad(fastest) < 75);
    CHECK(flight->warnings().is_at_limit);
}

TEST_CASE("a 500MD climbs at most 8.6 m/s for good, best at 60 kt or so") {
    double best = 0.0;
    double best_speed = 0.0;
    for (double speed = 0.0; speed <= 70.0; speed += 10.0) {
        const auto flight = trimmed(speed, 0.0);
        hold(*flight, 20, {0, 0, 0, 1});
        const double start_m = flight->state().position_m.z;
        hold(*flight, 40, {0, 0, 0, 1});
        const double climb = (flight->state().position_m.z - start_m) / 40.0;
        CHECK(climb <= 8.65);
        CHECK(flight->warnings().is_at_limit);
        best_speed = climb > best ? speed : best_speed;
        best = std::max(best, climb);
    }
    CHECK(best > 8.2);
    CHECK(best_speed == Approx(30).margin(10));
}

TEST_CASE("a 500MD cannot hover where the air is too thin for its power") {
    const auto flight = trimmed(0, 6000);
    hold(*flight, 30, {0, 0, 0, 1});
    CHECK(flight->state().velocity_mps.z < 0);
}

TEST_CASE("flat out a 500MD flies about its never-exceed speed, and pushed over hardly more") {
    const auto level = trimmed(50);
    fly(
        *level, 120, [&](double) { return level_flat_out(*level); },
        [](const PilotedFlight& f) { CHECK(speed_mps(f) < 79); });
    CHECK(speed_mps(*level) == Approx(77).margin(2));
    CHECK(std::abs(level->state().velocity_mps.z) < 1);

    const auto pushed = trimmed(60, 2000);
    double fastest = 0.0;
    fly(
        *pushed, 60,
        [](double) {
            return PilotControls{-1, 0, 0, 0.4};
        },
        [&](const PilotedFlight& f) { fastest = std::max(fastest, speed_mps(f)); });
    CHECK(fastest > 76);
    CHECK(fastest < 82);
    CHECK(pushed->warnings().is_at_limit);
}

TEST_CASE("collective down sinks a 500MD at an autorotation's rate and never gives it energy") {
    const auto flight = trimmed(30, 1500);
    hold(*flight, 3, {});
    CHECK(largest_rise_without_throttle_m(*flight, 5, 40) < 1e-4);
    const auto straight = trimmed(30, 1500);
    hold(*straight, 20, {});
    CHECK(straight->state().velocity_mps.z < -8);
    CHECK(straight->state().velocity_mps.z > -20);
}

TEST_CASE("a flight by hand takes a 500MD over as it is") {
    sim::AircraftState start;
    start.time_s = 0.123;
    start.position_m = {0, 0, 40};
    start.velocity_mps = {0, 40, 0};
    start.body_to_world = body_to_world_from_euler({0, 0, rad_from_deg(45)});
    start.load_factor = 1.41;
    const auto flight = sim::make_piloted_flight(sim::aircraft_kind("500md"), start);
    CHECK(same_bits(flight->state(), start));
    flight->step({0, 0.75, 0, flight->trim_throttle()});
    CHECK(flight->state().time_s == 0.123 + sim::time_of_step(1));
    CHECK(flight->state().load_factor == Approx(1.41).margin(0.02));
    CHECK(turn_radps(start.body_to_world, flight->state().body_to_world) < rad_from_deg(10));
}
