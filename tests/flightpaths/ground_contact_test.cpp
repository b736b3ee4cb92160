#include "flightpaths/ground_contact.h"
#include "flightpaths/placement.h"
#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

using namespace octant;
using namespace octant::flightpaths;

namespace {

constexpr double reach_m = 1.5;

/// A flight to the north over the given heights, level in attitude, a sample a second.
sim::Trajectory flight(
    int seconds, double speed_mps, const std::function<double(double)>& height_m, double stops_at_s = 1e9) {
    std::vector<sim::AircraftState> samples;
    double way_m = 0.0;
    for (int i = 0; i <= seconds; ++i) {
        const double speed_now_mps = i < stops_at_s ? speed_mps : 0.0;
        sim::AircraftState state;
        state.time_s = i;
        state.position_m = {0.0, way_m, height_m(i)};
        state.velocity_mps = {0.0, speed_now_mps, 0.5 * (height_m(i + 1) - height_m(i - 1))};
        state.body_to_world = body_to_world_from_euler({});
        samples.push_back(state);
        way_m += speed_now_mps;
    }
    return sim::Trajectory(std::move(samples));
}

GroundHeight level_ground(double height_m) {
    return [height_m](double, double) { return std::optional(height_m); };
}

void check_never_below(const sim::Trajectory& path, const GroundHeight& ground, double least_m) {
    for (double time_s = path.start_s(); time_s <= path.end_s(); time_s += 1.0 / 120.0) {
        const glm::dvec3 place_m = path.state_at(time_s).position_m;
        const double clearance_m = place_m.z - ground(place_m.x, place_m.y).value();
        if (clearance_m < least_m) { FAIL("at " << time_s << " s only " << clearance_m << " m above the ground"); }
    }
}

/// The largest change of the vertical speed a second, over pieces of half a second.
double roughest_mps2(const sim::Trajectory& path) {
    double roughest = 0.0;
    for (double time_s = path.start_s() + 0.5; time_s + 0.5 <= path.end_s(); time_s += 0.05) {
        const double before_m = path.state_at(time_s - 0.5).position_m.z;
        const double here_m = path.state_at(time_s).position_m.z;
        const double after_m = path.state_at(time_s + 0.5).position_m.z;
        roughest = std::max(roughest, std::abs(after_m - 2.0 * here_m + before_m) / 0.25);
    }
    return roughest;
}

TrackInference lands_at(double time_s, double end_s) {
    TrackInference inference;
    inference.phases = {{0.0, time_s, TrackPhase::Flight}, {time_s, end_s, TrackPhase::LandingRun}};
    return inference;
}

/// Descends at 3.5 m/s to `ground_m` at 60 s.
std::function<double(double)> approach(double ground_m) {
    return [ground_m](double time_s) { return ground_m + 3.5 * std::max(0.0, 60.0 - time_s); };
}

} // namespace

TEST_CASE("a landing recorded too high or too low ends on the ground, softly, without a jump anywhere") {
    for (const double wrong_m : {40.0, -35.0, 3.0}) {
        INFO(wrong_m);
        const sim::Trajectory track = flight(100, 60.0, approach(20.0 + wrong_m));
        const LaidTrack laid =
            laid_on_ground(track, lands_at(60.0, 100.0), level_ground(20.0), {.reach_below_m = reach_m});
        check_never_below(laid.trajectory, level_ground(20.0), reach_m - 1e-6);
        for (const double time_s : {60.0, 61.3, 80.0, 100.0}) {
            CHECK(laid.trajectory.state_at(time_s).position_m.z == Approx(20.0 + reach_m).margin(1e-6));
        }
        // Vertical speed where it touches down.
        CHECK(std::abs(laid.trajectory.state_at(60.0).velocity_mps.z) < 0.5);
        CHECK(roughest_mps2(laid.trajectory) < 5.0); // half the weight
        // Far from the ground the whole flight is moved by the same height.
        CHECK(laid.trajectory.state_at(10.0).position_m.z - track.state_at(10.0).position_m.z ==
              Approx(reach_m - wrong_m).margin(0.01));
        REQUIRE(laid.report.contacts.size() == 1);
        CHECK(laid.report.contacts[0].added_from_m == Approx(reach_m - wrong_m));
    }
}

TEST_CASE("between take-off and landing heights change by what lies between both differences") {
    const auto height_m = [](double time_s) {
        return 100.0 + std::clamp(2.0 * (time_s - 50.0), 0.0, 200.0) - std::clamp(2.0 * (time_s - 350.0), 0.0, 200.0);
    };
    const sim::Trajectory track = flight(500, 50.0, height_m);
    TrackInference inference;
    inference.phases = {
        {0, 50, TrackPhase::TakeOffRun}, {50, 450, TrackPhase::Flight}, {450, 500, TrackPhase::LandingRun}};
    const GroundHeight ground = [](double, double y_m) { return std::optional(y_m < 10'000.0 ? 90.0 : 130.0); };
    const LaidTrack laid = laid_on_ground(track, inference, ground, {.reach_below_m = reach_m, .by_pressure = true});
    const auto added_m = [&](double time_s) {
        return laid.trajectory.state_at(time_s).position_m.z - track.state_at(time_s).position_m.z;
    };
    CHECK(added_m(20.0) == Approx(-8.5));
    CHECK(added_m(250.0) == Approx(11.5).margin(0.2));
    CHECK(added_m(480.0) == Approx(31.5));
    for (double time_s = 0.0; time_s < 499.5; time_s += 0.1) {
        CHECK(std::abs(added_m(time_s + 0.1) - added_m(time_s)) < 0.25);
    }
    // A pressure height of 8.5 m too much at 91.5 m: about a hectopascal less than the standard.
    REQUIRE(laid.report.qnh_take_off_hpa);
    CHECK(*laid.report.qnh_take_off_hpa == Approx(1013.25 - 1.02).margin(0.1));
    REQUIRE(laid.report.qnh_landing_hpa);
    CHECK(*laid.report.qnh_landing_hpa == Approx(1013.25 + 3.75).margin(0.1));
}

TEST_CASE("altimeter settings are those of the standard atmosphere") {
    CHECK(qnh_hpa(0.0, 0.0) == Approx(1013.25));
    // Tables: 1000 hPa lie 111 m above 1013.25 hPa.
    CHECK(qnh_hpa(110.9, 0.0) == Approx(1000.0).margin(0.05));
    CHECK(qnh_hpa(1500.0, 1500.0) == Approx(1013.25));
}

TEST_CASE("a run over rough ground never dips below it and is not thrown about") {
    const GroundHeight rough = [](double, double y_m) {
        return std::optional(30.0 + 0.02 * y_m + 2.0 * std::sin(y_m / 60.0) + 0.7 * std::sin(y_m / 17.0));
    };
    const sim::Trajectory track = flight(60, 60.0, [](double) { return 50.0; });
    TrackInference inference;
    inference.phases = {{0.0, 60.0, TrackPhase::LandingRun}};
    const LaidTrack laid = laid_on_ground(track, inference, rough, {.reach_below_m = reach_m});
    check_never_below(laid.trajectory, rough, reach_m - 0.01);
    CHECK(roughest_mps2(laid.trajectory) < 4.0);
}

TEST_CASE("a flight over a cliff stays as it was recorded, and so does one far above what seems to be the ground") {
    const GroundHeight cliff = [](double, double y_m) { return std::optional(y_m < 1500.0 ? 100.0 : 400.0); };
    const sim::Trajectory track = flight(60, 50.0, [](double) { return 450.0; });
    TrackInference in_flight;
    in_flight.phases = {{0.0, 60.0, TrackPhase::Flight}};
    const LaidTrack same = laid_on_ground(track, in_flight, cliff, {.reach_below_m = reach_m});
    for (std::size_t i = 0; i < track.samples().size(); ++i) {
        CHECK(same.trajectory.samples()[i].position_m == track.samples()[i].position_m);
    }
    CHECK(same.notes.empty());
    TrackInference slow;
    slow.phases = {{0.0, 20.0, TrackPhase::Flight}, {20.0, 30.0, TrackPhase::Taxi}, {30.0, 60.0, TrackPhase::Flight}};
    const LaidTrack above = laid_on_ground(track, slow, cliff, {.reach_below_m = reach_m});
    CHECK(above.trajectory.state_at(25.0).position_m.z == 450.0);
    REQUIRE(above.notes.size() == 1);
    CHECK_THAT(above.notes[0], Catch::Contains("seems to be on the ground"));
}

TEST_CASE("a taxi to the edge of a cliff keeps to the plateau, and the flight from it leaves the ground below") {
    const GroundHeight cliff = [](double, double y_m) { return std::optional(y_m < 1000.0 ? 300.0 : 0.0); };
    const sim::Trajectory track = flight(60, 40.0, [](double) { return 302.0; });
    TrackInference inference;
    inference.phases = {{0.0, 24.0, TrackPhase::TakeOffRun}, {24.0, 60.0, TrackPhase::Flight}};
    const LaidTrack laid = laid_on_ground(track, inference, cliff, {.reach_below_m = reach_m});
    CHECK(laid.trajectory.state_at(10.0).position_m.z == Approx(301.5));
    CHECK(laid.trajectory.state_at(50.0).position_m.z == Approx(301.5).margin(0.1));
}

TEST_CASE("a helicopter that lands on a slope stands as the slope does") {
    const double slope = std::tan(rad_from_deg(10.0));
    const GroundHeight hillside = [&](double x_m, double y_m) {
        return std::optional(500.0 + slope * y_m - 0.5 * slope * x_m);
    };
    const sim::Trajectory track = flight(
        60, 0.0, [](double time_s) { return 505.0 + std::max(0.0, 30.0 - time_s); }, 0.0);
    TrackInference inference;
    inference.hovers = true;
    inference.phases = {{0.0, 30.0, TrackPhase::Hover}, {30.0, 60.0, TrackPhase::Parked}};
    const LaidTrack laid = laid_on_ground(track, inference, hillside, {.reach_below_m = reach_m});
    const EulerAngles stands = euler_from_body_to_world(laid.trajectory.state_at(45.0).body_to_world);
    CHECK(deg_from_rad(stands.pitch_rad) == Approx(10.0).margin(0.1));
    // The ground falls to the right, which is east.
    CHECK(deg_from_rad(stands.roll_rad) == Approx(deg_from_rad(std::atan(0.5 * slope))).margin(0.1));
    const EulerAngles hovers = euler_from_body_to_world(laid.trajectory.state_at(20.0).body_to_world);
    CHECK(deg_from_rad(hovers.pitch_rad) == Approx(0.0).margin(0.1));
    CHECK(laid.trajectory.state_at(45.0).position_m.z - 500.0 ==
          Approx(reach_m / std::cos(rad_from_deg(10.0))).margin(0.05));
    CHECK(std::abs(laid.trajectory.state_at(30.0).velocity_mps.z) < 0.5);
}

TEST_CASE("a flight a little in the ground is lifted out of it smoothly, one deep in it is left to be refused") {
    const GroundHeight hill = [](double, double y_m) {
        return std::optional(200.0 * std::exp(-std::pow((y_m - 1500.0) / 300.0, 2.0)));
    };
    TrackInference in_flight;
    in_flight.phases = {{0.0, 60.0, TrackPhase::Flight}};
    const sim::Trajectory low = flight(60, 50.0, [](double) { return 185.0; });
    const LaidTrack lifted = laid_on_ground(low, in_flight, hill, {.reach_below_m = reach_m});
    check_never_below(lifted.trajectory, hill, 0.0);
    CHECK(lifted.report.lifted_m == Approx(15.0 + 0.5 * reach_m).margin(0.2));
    CHECK(lifted.trajectory.state_at(5.0).position_m.z == 185.0);
    CHECK(roughest_mps2(lifted.trajectory) < 6.0);
    const sim::Trajectory deep = flight(60, 50.0, [](double) { return 100.0; });
    const LaidTrack refused = laid_on_ground(deep, in_flight, hill, {.reach_below_m = reach_m});
    CHECK(refused.trajectory.state_at(30.0).position_m.z == 100.0);
    CHECK_THROWS(check_over_ground(refused.trajectory, hill));
}
