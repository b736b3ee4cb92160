#include "sim/base/axes.h"
#include "tests/visuals/planning/small_world.h"
#include "visuals/planning/control_positions.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace octant;
using namespace octant::visuals;

namespace {

double position(const sim::AircraftState& state, models::FlightControl control, const landscape::Ground& ground) {
    return planning::control_positions(state, ground)[static_cast<std::size_t>(control)];
}

} // namespace

TEST_CASE("controls follow the motion: roll, load, yaw without bank, loss of speed, and gear near the ground") {
    using enum models::FlightControl;
    const auto ground = tests::cell_ground(4, 1000.0, [](double, double) { return 0.0; });
    sim::AircraftState state;
    state.position_m = {0.0, 0.0, 1000.0};
    state.velocity_mps = {0.0, 60.0, 0.0};
    state.body_to_world = body_to_world_from_euler({});
    for (const double moved : planning::control_positions(state, *ground)) { CHECK(moved == 0.0); }

    state.turn_rate_radps = {1.0, 0.0, 0.0};
    CHECK(position(state, Roll, *ground) == Approx(0.7071).margin(1e-3));
    state.turn_rate_radps = {-1.0, 0.0, 0.0};
    CHECK(position(state, Roll, *ground) == Approx(-0.7071).margin(1e-3));
    state.turn_rate_radps = {0.0, 0.0, 0.2};
    CHECK(position(state, Yaw, *ground) > 0.3);
    state.turn_rate_radps = {};
    state.load_factor = 3.0;
    CHECK(position(state, Pitch, *ground) > 0.3);
    state.speed_rate_mps2 = -9.0;
    CHECK(position(state, SpeedBrake, *ground) == 1.0);

    CHECK(position(state, Gear, *ground) == 0.0);
    state.position_m.z = 50.0;
    CHECK(position(state, Gear, *ground) == 1.0);
    CHECK(position(state, Flaps, *ground) == Approx(0.7));
    state.velocity_mps = {0.0, 200.0, 0.0};
    CHECK(position(state, Gear, *ground) == 0.0);
    state.velocity_mps = {0.0, 60.0, 0.0};
    state.position_m.x = 1e7; // where there is no ground
    CHECK(position(state, Gear, *ground) == 0.0);
}

TEST_CASE("gear is never half-way in level flight, and moves on an approach and after take-off") {
    const auto ground = tests::cell_ground(4, 1000.0, [](double, double) { return 0.0; });
    sim::AircraftState state;
    state.body_to_world = body_to_world_from_euler({});
    const auto gear_at = [&](double height_m, double speed_mps, double climb_mps) {
        state.position_m = {0.0, 0.0, height_m};
        state.velocity_mps = {0.0, speed_mps, climb_mps};
        return position(state, models::FlightControl::Gear, *ground);
    };
    for (double height_m = 5.0; height_m < 200.0; height_m += 0.5) {
        for (const double speed_mps : {60.0, 109.0, 110.0, 114.0}) {
            const double level = gear_at(height_m, speed_mps, 0.0);
            CHECK((level == 0.0 || level == 1.0));
        }
    }
    CHECK(gear_at(150.0, 60.0, -3.0) == 0.0);
    CHECK(gear_at(120.0, 60.0, -3.0) == Approx(0.5));
    CHECK(gear_at(110.0, 60.0, -3.0) == 1.0);
    CHECK(gear_at(40.0, 60.0, 5.0) == 1.0);
    CHECK(gear_at(60.0, 60.0, 5.0) == Approx(0.5));
    CHECK(gear_at(80.0, 60.0, 5.0) == 0.0);
}

TEST_CASE("in a coordinated turn the rudder stays in the middle") {
    const auto ground = tests::cell_ground(4, 1000.0, [](double, double) { return 0.0; });
    const double bank_rad = 0.6;
    sim::AircraftState state;
    state.position_m = {0.0, 0.0, 1000.0};
    state.velocity_mps = {0.0, 80.0, 0.0};
    state.body_to_world = body_to_world_from_euler({.heading_rad = 0.0, .pitch_rad = 0.0, .roll_rad = bank_rad});
    const double turn_radps = 9.80665 * std::tan(bank_rad) / 80.0;
    state.turn_rate_radps = turn_radps * glm::dvec3(0.0, std::sin(bank_rad), std::cos(bank_rad));
    CHECK(position(state, models::FlightControl::Yaw, *ground) == Approx(0.0).margin(1e-9));
}
