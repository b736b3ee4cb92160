#include "tests/sim/hand_flights.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace octant;
using namespace octant::tests;
using sim::PilotControls;
using sim::PilotedFlight;

namespace {

/// Angle between the nose and the velocity, in the aircraft's plane of symmetry.
double alpha_rad(const PilotedFlight& flight) {
    const glm::dvec3 in_body = glm::conjugate(flight.state().body_to_world) * flight.state().velocity_mps;
    return std::atan2(in_body.z, in_body.x);
}

double climb_deg(const PilotedFlight& flight) {
    const glm::dvec3& v = flight.state().velocity_mps;
    return deg_from_rad(std::atan2(v.z, std::hypot(v.x, v.y)));
}

} // namespace

TEST_CASE("a slow F-15 held back stalls, sinks nose down, and recovers when released") {
    const auto flight = trimmed_f15(90, 3000);
    double highest_pitch = 0.0;
    double steepest_alpha = 0.0;
    hold(*flight, 1, {1, 0, 0, 0});
    CHECK(flight->warnings().stalled);
    fly(
        *flight, 9,
        [](double) {
            return PilotControls{1, 0, 0, 0};
        },
        [&](const PilotedFlight& f) {
            highest_pitch = std::max(highest_pitch, angles_of(f).pitch_rad);
            steepest_alpha = std::max(steepest_alpha, alpha_rad(f));
        });
    CHECK(flight->warnings().stalled);
    CHECK(flight->state().load_factor < 0.7);
    CHECK(flight->state().velocity_mps.z < -20);
    CHECK(deg_from_rad(steepest_alpha) > 30);
    CHECK(angles_of(*flight).pitch_rad < highest_pitch - rad_from_deg(20));
    hold(*flight, 10, {0, 0, 0, 0.8});
    CHECK_FALSE(flight->warnings().stalled);
    CHECK(speed_mps(*flight) > 80);
    CHECK(deg_from_rad(alpha_rad(*flight)) < 15);
    // It flies again: pulled gently out of the dive it climbs.
    hold(*flight, 12, {0.3, 0, 0, 1});
    CHECK(flight->state().velocity_mps.z > 0);
}

TEST_CASE("an F-15 left to itself without thrust slows down, stalls and dives out of it") {
    const auto flight = trimmed_f15(120, 3000);
    bool stalled = false;
    double slowest = 1e9;
    fly(
        *flight, 70, [](double) { return PilotControls{}; },
        [&](const PilotedFlight& f) {
            stalled = stalled || f.warnings().stalled;
            slowest = std::min(slowest, speed_mps(f));
        });
    CHECK(stalled);
    CHECK(slowest > 40);
    CHECK_FALSE(flight->warnings().stalled);
    CHECK(speed_mps(*flight) > slowest + 20);
    // Then it glides, above its stall.
    hold(*flight, 30, {});
    CHECK_FALSE(flight->warnings().stalled);
    CHECK(std::abs(climb_deg(*flight)) < 10);
}

TEST_CASE("an F-15 let go in a stall comes back to level flight by itself") {
    for (const double bank_deg : {0.0, 30.0}) {
        CAPTURE(bank_deg);
        const auto flight = trimmed_f15(90, 3000);
        hold(*flight, bank_deg / 60.0, {0, 0.5, 0, 0});
        hold(*flight, 10, {1, 0, 0, 0});
        REQUIRE(flight->warnings().stalled);
        REQUIRE(climb_deg(*flight) < -25);
        hold(*flight, 25, {0, 0, 0, 0.5});
        CHECK_FALSE(flight->warnings().stalled);
        CHECK(std::abs(climb_deg(*flight)) < 1.5);
        CHECK(flight->state().position_m.z > 2000);
        CHECK(speed_mps(*flight) > 90);
    }
}

TEST_CASE("an F-15 let go in a dive that was no stall keeps diving") {
    const auto flight = trimmed_f15(200, 5000);
    hold(*flight, 3, {-0.5, 0, 0, 0.3});
    const double climb = climb_deg(*flight);
    REQUIRE(climb < -12);
    hold(*flight, 5, {0, 0, 0, 0.3});
    CHECK(climb_deg(*flight) == Approx(climb).margin(3));
}

TEST_CASE("an F-15 thrown straight up comes down nose first and flies again") {
    const auto flight = trimmed_f15(200, 5000);
    hold(*flight, 4.5, {0.8, 0, 0, 1});
    CHECK(angles_of(*flight).pitch_rad > rad_from_deg(60));
    double slowest = 1e9;
    fly(
        *flight, 40, [](double) { return PilotControls{}; },
        [&](const PilotedFlight& f) { slowest = std::min(slowest, speed_mps(f)); });
    CHECK(slowest < 60);
    CHECK(speed_mps(*flight) > 100);
    CHECK(std::abs(deg_from_rad(alpha_rad(*flight))) < 15);
    CHECK(flight->state().velocity_mps.z < 0);
    CHECK(std::abs(climb_deg(*flight)) < 15);
}
