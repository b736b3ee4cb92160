#include "sim/aircraft_kind.h"
#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "ui/flight/simulation.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>

#include "small_flight.h"

using namespace octant;
using namespace octant::tests;
using ui::flight::Simulation;

TEST_CASE("a flight is the same however often it is asked where it is") {
    const ui::world::World world = small_world(3);
    Simulation at_once(world);
    at_once.advance_to(4.0);
    Simulation often(world);
    for (const double time_s : {0.001, 0.5, 0.5, 1.37, 3.9999, 4.0}) { often.advance_to(time_s); }
    CHECK(often.state_hash() == at_once.state_hash());
    CHECK(often.step() == at_once.step());
    CHECK(often.states()[2].position_m == at_once.states()[2].position_m);
    often.advance_to(4.1);
    CHECK(often.state_hash() != at_once.state_hash());
}

TEST_CASE("along a path the leader is where the path has it, and the others beside him") {
    const ui::world::World world = small_world(2);
    Simulation simulation(world);
    simulation.advance_to(2.345);
    const sim::AircraftState leader = world.flight.trajectory.state_at(2.345);
    REQUIRE(simulation.states().size() == 2);
    CHECK(simulation.states()[0].position_m == leader.position_m);
    CHECK(simulation.states()[1].position_m == simulation.formation().wingman_state(leader, 1).position_m);
}

TEST_CASE("a simulation that begins anew forgets what it has flown") {
    const ui::world::World world = small_world();
    Simulation fresh(world);
    fresh.begin_at(3.0);
    fresh.advance_to(5.0);
    Simulation flown(world);
    flown.advance_to(8.0);
    flown.begin_at(3.0);
    flown.advance_to(5.0);
    CHECK(flown.state_hash() == fresh.state_hash());
}

TEST_CASE("the log holds the leader at every step since it was started") {
    const ui::world::World world = small_world();
    Simulation simulation(world);
    simulation.advance_to(1.0);
    const long from = simulation.step();
    simulation.start_log();
    simulation.advance_to(2.0);
    REQUIRE(static_cast<long>(simulation.log().size()) == simulation.step() - from + 1);
    CHECK(simulation.log().front().position_m.y == Approx(-400.0).margin(1.0));
    CHECK(simulation.log().back().position_m.y == Approx(-300.0).margin(1.0));
}

TEST_CASE("a dive by hand ends on the ground, and levelling off goes on above it") {
    const ui::world::World world = small_world();
    Simulation simulation(world);
    simulation.advance_to(1.0);
    simulation.take_over(sim::aircraft_kind("f15"));
    REQUIRE(simulation.by_hand());
    sim::PilotControls push = simulation.controls();
    push.pitch = -1.0;
    simulation.set_controls(push);
    simulation.advance_to(15.0);
    CHECK(simulation.end_of_flight() == Simulation::End::OnTheGround);
    CHECK(simulation.states().front().position_m.z > 0.0);
    simulation.level_off();
    CHECK_FALSE(simulation.end_of_flight());
    simulation.advance_to(15.5);
    CHECK(simulation.states().front().position_m.z > 150.0);
}

TEST_CASE("a flight that goes on after the ground clears the wall before it") {
    ui::world::World world = small_world();
    world.scene.ground = ground_with_plateau(600.0);
    Simulation simulation(world);
    simulation.take_over(sim::aircraft_kind("f15"));
    simulation.set_controls({.pitch = -1.0});
    simulation.advance_to(30.0);
    REQUIRE(simulation.end_of_flight() == Simulation::End::OnTheGround);
    REQUIRE(simulation.states().front().position_m.y < 600.0);
    simulation.level_off();
    simulation.advance_to(60.0);
    CHECK(simulation.end_of_flight() == Simulation::End::OffTheMap);
}

TEST_CASE("levelling off flies there, step by step, and ends where the stick is moved") {
    const ui::world::World world = small_world();
    Simulation simulation(world);
    simulation.take_over(sim::aircraft_kind("f15"));
    sim::PilotControls roll = simulation.controls();
    roll.roll = -0.3;
    simulation.set_controls(roll);
    simulation.advance_to(1.5);
    const auto bank_deg = [&] {
        return deg_from_rad(euler_from_body_to_world(simulation.states().front().body_to_world).roll_rad);
    };
    const double banked = bank_deg();
    REQUIRE(banked < -40.0);
    simulation.level_off();
    CHECK(simulation.is_levelling());
    simulation.advance_to(1.55);
    CHECK(std::abs(bank_deg() - banked) < 15.0);
    simulation.advance_to(9.0);
    CHECK(std::abs(bank_deg()) < 1.0);
    CHECK(std::abs(simulation.states().front().velocity_mps.z) < 6.0);
    simulation.level_off();
    simulation.set_controls(roll);
    CHECK_FALSE(simulation.is_levelling());
}

TEST_CASE("both aircraft end on the ground in the same way") {
    for (const char* const name : {"f15", "500md"}) {
        CAPTURE(name);
        const ui::world::World world = small_world();
        Simulation simulation(world);
        simulation.take_over(sim::aircraft_kind(name));
        simulation.set_controls({.pitch = -0.5});
        simulation.advance_to(30.0);
        CHECK(simulation.end_of_flight() == Simulation::End::OnTheGround);
        const glm::dvec3 at_m = simulation.states().front().position_m;
        CHECK(at_m.z > 0.0);
        simulation.advance_to(31.0);
        CHECK(simulation.states().front().position_m == at_m);
    }
}

TEST_CASE("a flight by hand straight ahead ends at the border of the map") {
    const ui::world::World world = small_world();
    Simulation simulation(world);
    simulation.take_over(sim::aircraft_kind("f15"));
    simulation.start_level();
    simulation.advance_to(60.0);
    CHECK(simulation.end_of_flight() == Simulation::End::OffTheMap);
    CHECK(simulation.states().front().position_m.y > 1900.0);
    CHECK(simulation.states().front().position_m.y <= 2000.0);
}
