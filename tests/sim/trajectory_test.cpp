#include "sim/base/axes.h"
#include "sim/flight_steps.h"
#include "sim/trajectory.h"

#include <catch2/catch.hpp>

using namespace octant;
using sim::AircraftState;
using sim::Trajectory;

namespace {

AircraftState sample(double time_s, glm::dvec3 position_m, glm::dvec3 velocity_mps, double heading_rad) {
    return {time_s, position_m, velocity_mps, body_to_world_from_euler({heading_rad, 0, 0}), 1.0};
}

} // namespace

TEST_CASE("a trajectory goes through its samples and stays at its ends") {
    const Trajectory path({sample(1, {0, 0, 0}, {10, 0, 0}, 0), sample(2, {10, 0, 0}, {10, 0, 0}, 1)});
    CHECK(path.state_at(0.0).position_m.x == 0.0);
    CHECK(path.state_at(1.0).time_s == 1.0);
    CHECK(path.state_at(1.5).position_m.x == Approx(5.0));
    CHECK(path.state_at(1.5).velocity_mps.x == Approx(10.0));
    CHECK(path.state_at(9.0).position_m.x == 10.0);
}

TEST_CASE("a trajectory knows how fast it turns about its body axes") {
    const auto rolled = [](double time_s, double roll_rad) {
        AircraftState state = sample(time_s, {0, 0, 0}, {10, 0, 0}, 0);
        state.body_to_world = body_to_world_from_euler({1.0, 0.2, roll_rad});
        return state;
    };
    const Trajectory path({rolled(0.0, 0.0), rolled(0.1, 0.05), rolled(0.2, 0.1), rolled(0.3, 0.1)});
    CHECK(path.state_at(0.1).turn_rate_radps.x == Approx(0.5).margin(1e-3));
    CHECK(path.state_at(0.25).turn_rate_radps.x == Approx(0.125).margin(1e-3));
    CHECK(path.state_at(0.1).turn_rate_radps.y == Approx(0.0).margin(1e-9));
    CHECK(Trajectory({rolled(0.0, 0.0)}).state_at(0.0).turn_rate_radps == glm::dvec3(0.0));
}

TEST_CASE("outside its times a trajectory gives the sample at that end as it is") {
    const Trajectory path({sample(1, {0, 0, 0}, {10, 0, 0}, 0), sample(2, {10, 0, 0}, {20, 0, 0}, 1)});
    CHECK(path.state_at(0.0).time_s == 1.0);
    CHECK(path.state_at(0.0).velocity_mps.x == 10.0);
    CHECK(path.state_at(9.0).time_s == 2.0);
    CHECK(path.state_at(9.0).velocity_mps.x == 20.0);
    CHECK(path.state_at(9.0).body_to_world == path.samples()[1].body_to_world);
}

TEST_CASE("heading turns evenly between samples") {
    const Trajectory path({sample(0, {0, 0, 0}, {0, 0, 0}, 0), sample(1, {0, 0, 0}, {0, 0, 0}, 1)});
    const auto angles = euler_from_body_to_world(path.state_at(0.25).body_to_world);
    CHECK(angles.heading_rad == Approx(0.25));
}

TEST_CASE("position and velocity are continuous across a sample") {
    const Trajectory path(
        {sample(0, {0, 0, 0}, {1, 2, 0}, 0), sample(1, {3, 1, 0}, {0, 1, 1}, 0), sample(2, {4, 0, 2}, {2, 0, 0}, 0)});
    const auto before = path.state_at(1.0 - 1e-7);
    const auto after = path.state_at(1.0 + 1e-7);
    CHECK(glm::length(before.position_m - after.position_m) < 1e-6);
    CHECK(glm::length(before.velocity_mps - after.velocity_mps) < 1e-5);
}

TEST_CASE("steps and times convert without drift") {
    for (long step = -10; step < 5000; ++step) { CHECK(sim::step_at(sim::time_of_step(step)) == step); }
    CHECK(sim::step_at(0.05 * 799) == 799 * 6);
    CHECK(sim::step_at(1e7) == 1'200'000'000L);
    CHECK(sim::step_at(-1e7) == -1'200'000'000L);
}
