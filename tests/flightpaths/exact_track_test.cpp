#include "flightpaths/placement.h"
#include "flightpaths/recorded_track.h"
#include "flightpaths/track_writer.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/flight_models.h"
#include "sim/flight_steps.h"
#include "tests/flightpaths/track_fault.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

using namespace octant;
using namespace octant::flightpaths;
using octant::sim::HeightMode;
using octant::tests::replaced;
using octant::tests::track_fault;
using octant::tests::written;

namespace {

/// Of all fields before speed_rate_mps2, which trajectories work out themselves.
bool same_bits(const sim::AircraftState& a, const sim::AircraftState& b) {
    return std::memcmp(&a, &b, offsetof(sim::AircraftState, speed_rate_mps2)) == 0;
}

/// A flight by hand with every control in use: pulls, rolls, slips and a stall.
std::vector<sim::AircraftState> states_of_kind(const sim::AircraftKind& kind, long steps) {
    const bool jet = kind.flight_model == sim::FlightModel::FixedWing;
    const auto flight = sim::make_piloted_flight(kind, sim::trimmed_state(kind, {0, 0, 2500}, 1.1, jet ? 210 : 25));
    std::vector<sim::AircraftState> states{flight->state()};
    for (long step = 0; step < steps; ++step) {
        const double t = sim::time_of_step(step);
        flight->step({0.25 + 0.5 * std::sin(0.7 * t), 0.4 * std::sin(0.31 * t), 0.2 * std::sin(t),
            0.6 + 0.3 * std::sin(0.2 * t)});
        states.push_back(flight->state());
    }
    return states;
}

const std::string exact_head = "t_s,north_m,east_m,alt_m,q_w,q_x,q_y,q_z\n";

} // namespace

TEST_CASE("a flight by hand comes back from its file to the last bit, over the ground, too") {
    for (const sim::AircraftKind& kind : sim::aircraft_kinds()) {
        const auto states = states_of_kind(kind, 3000);
        const auto file = written("exact.csv", exact_track_csv(sim::Trajectory(states)));
        const RecordedTrack track = read_recorded_track(file);
        const PlacedPath placed = place_over_ground(
            track.trajectory, {{0, 0}, 0.0, HeightMode::Datum}, [](double, double) { return -20000.0; }, 30,
            std::nullopt);
        REQUIRE(track.trajectory.samples().size() == states.size());
        bool read = true;
        bool looked_up = true;
        bool over_ground = true;
        for (std::size_t i = 0; i < states.size(); ++i) {
            const double time_s = sim::time_of_step(static_cast<long>(i));
            read = read && same_bits(track.trajectory.samples()[i], states[i]);
            looked_up = looked_up && same_bits(track.trajectory.state_at(time_s), states[i]);
            over_ground = over_ground && same_bits(placed.trajectory.state_at(time_s), states[i]);
        }
        CHECK(read);
        CHECK(looked_up);
        CHECK(over_ground);
        CHECK(placed.offset_m == 0.0);
    }
}

TEST_CASE("an exact track keeps minus zeros, tiny and long numbers") {
    const double third = 1.0 / 3.0;
    const double least = std::numeric_limits<double>::denorm_min();
    const glm::dquat attitude = body_to_world_from_euler({0.1234567890123, -0.777, 3.1});
    const std::vector<sim::AircraftState> states{
        {-0.0, {-0.0, third, 1e-300}, {least, -0.0, 99.0 + third}, attitude, -third},
        {third, {0.1 + 0.2, 600.0 + third, -4.0}, {-1e-17, 0.0, 1.0}, -attitude, -0.0}};
    const std::string text = exact_track_csv(sim::Trajectory(states));
    const RecordedTrack track = read_recorded_track(written("odd.csv", text));
    CHECK(same_bits(track.trajectory.samples()[0], states[0]));
    CHECK(same_bits(track.trajectory.samples()[1], states[1]));
    const PlacedPath placed = place_over_ground(
        track.trajectory, {{0, 0}, 0.0, HeightMode::Datum}, [](double, double) { return -100.0; }, 30, std::nullopt);
    CHECK(same_bits(placed.trajectory.samples()[0], states[0]));
    CHECK(same_bits(placed.trajectory.samples()[1], states[1]));
}

TEST_CASE("an exact track is written with its columns and the shortest numbers") {
    const sim::Trajectory path(
        {{0.0, {1, 2, 3}, {4, 5, 6}, {1, 0, 0, 0}, 1.0}, {0.05, {1.5, 2, 0.1}, {4, 5, 6}, {0, 0.6, 0, -0.8}, 1.25}});
    CHECK(exact_track_csv(path) == "t_s,north_m,east_m,alt_m,v_north_mps,v_east_mps,v_up_mps,n_g,q_w,q_x,q_y,q_z\n"
                                   "0,2,1,3,5,4,6,1,1,0,0,0\n"
                                   "0.05,2,1.5,0.1,5,4,6,1.25,0,0.6,0,-0.8\n");
}

TEST_CASE("quaternions stand in place of angles, and are made unit where they nearly are") {
    const RecordedTrack track = read_recorded_track(
        written("nearly.csv", "t_s,north_m,east_m,alt_m,roll_deg,pitch_deg,yaw_deg,q_z,q_y,q_x,q_w\n"
                              "0,0,0,0,10,20,30,-0.8000004,0,0.6000003,0\n"
                              "1,1,0,0,10,20,30,0,0,0,1\n"));
    const glm::dquat first = track.trajectory.samples()[0].body_to_world;
    CHECK(first.x == Approx(0.6).epsilon(1e-12));
    CHECK(first.z == Approx(-0.8).epsilon(1e-12));
    CHECK(glm::length(first) == Approx(1).epsilon(1e-15));
    CHECK(track.trajectory.samples()[1].body_to_world == glm::dquat(1, 0, 0, 0));
    // What is not told is made from the motion, as without quaternions.
    CHECK(track.trajectory.samples()[0].velocity_mps.y == Approx(1));
}

TEST_CASE("quaternions that are not unit or not whole are refused with their line") {
    const std::string good = exact_head + "0,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n";
    CHECK(track_fault(good) == "no error");
    CHECK(track_fault(replaced(good, "1,0,0,0,1,0", "1,0,0,0,1,0.1")) ==
          "3: expected a unit quaternion q_w, q_x, q_y, q_z, got one of length 1.004988");
    CHECK(track_fault(replaced(good, "0,0,0,0,1,0,0,0\n", "0,0,0,0,0,0,0,0\n")) ==
          "2: expected a unit quaternion q_w, q_x, q_y, q_z, got one of length 0");
    CHECK(track_fault(replaced(good, "0,0,0,0,1,0,0,0\n", "0,0,0,0,1e200,1e200,0,0\n")) ==
          "2: expected a unit quaternion q_w, q_x, q_y, q_z, got one of length inf");
    CHECK(track_fault(replaced(good, "0,0,0,0,1,0,0,0\n", "0,0,0,0,1,x,0,0\n")) ==
          "2: expected a finite number in column q_x, got 'x'");
    CHECK(
        track_fault(replaced(good, "q_y,", "p_y,")) == "1: expected all of the columns q_w, q_x, q_y, q_z, got no q_y");
    CHECK(track_fault("t_s,north_m,east_m,alt_m,q_z\n0,0,0,0,1\n") ==
          "1: expected all of the columns q_w, q_x, q_y, q_z, got no q_w");
    CHECK(track_fault(replaced(good, "q_z", "q_w")) == "1: expected column q_w once, got it twice");
}
