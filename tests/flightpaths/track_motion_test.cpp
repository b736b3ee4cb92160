#include "flightpaths/recorded_track.h"
#include "flightpaths/track_motion.h"
#include "flightpaths/track_recording.h"
#include "sim/base/axes.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "tests/flightpaths/generated_tracks.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::flightpaths;
using namespace octant::tests;

namespace {

TrackMotion motion_in(const std::string& log) {
    return motion_of(parse_track_recording(log, "generated.csv").aircraft.front());
}

} // namespace

TEST_CASE("generated tracks come back as they were flown: two of each kind") {
    for (const std::string_view kind : generated_kinds) {
        std::vector<TrackFigures> both;
        for (int seed = 100; seed < 102; ++seed) {
            INFO(kind << " " << seed);
            const GeneratedTrack track = generated_track(kind, seed);
            const TrackFigures figures = figures_of(track, motion_in(track.log).trajectory);
            const double allowed_m = std::max(1.0, track.logger.noise_m * std::sqrt(2.0));
            CHECK(figures.horizontal_rms_m < allowed_m);
            CHECK(figures.vertical_rms_m < std::max(1.0, track.logger.height_step_m / std::sqrt(12.0)));
            both.push_back(figures);
            CHECK(figures.backwards_m < 0.01);
            if (kind == "parked") {
                CHECK(figures.pitch_most_deg < 2.0);
                CHECK(figures.roll_most_deg < 2.0);
            }
        }
        INFO(kind);
        CHECK(figures_of_all(both).pitch_rms_deg < 3.0);
        CHECK(figures_of_all(both).roll_rms_deg < 3.0);
    }
}

namespace {

TrackedAircraft sampled(int count, double step_s, const std::function<glm::dvec3(double)>& place_m) {
    TrackedAircraft aircraft;
    for (int i = 0; i < count; ++i) {
        TrackSample sample;
        sample.time_s = step_s * i;
        sample.position_m = place_m(sample.time_s);
        aircraft.samples.push_back(sample);
    }
    return aircraft;
}

} // namespace

TEST_CASE("a recording with all attitudes is flown through its places as they are, with its attitudes") {
    TrackedAircraft aircraft =
        sampled(60, 1.0, [](double t) { return glm::dvec3(50.0 * t + std::sin(9.1 * t), std::cos(7.3 * t), 900.0); });
    for (TrackSample& sample : aircraft.samples) {
        sample.heading_rad = 1.5 + 0.01 * sample.time_s;
        sample.pitch_rad = 0.02;
        sample.roll_rad = -0.3;
    }
    const TrackMotion motion = motion_of(aircraft);
    REQUIRE(motion.trajectory.samples().size() == 60);
    CHECK(motion.notes.empty());
    CHECK(motion.inference.horizontal_error_m == 0.0);
    for (std::size_t i = 0; i < 60; ++i) {
        CHECK(motion.trajectory.samples()[i].position_m == aircraft.samples[i].position_m);
        const TrackSample& sample = aircraft.samples[i];
        CHECK(motion.trajectory.samples()[i].body_to_world ==
              body_to_world_from_euler({sample.heading_rad, sample.pitch_rad, sample.roll_rad}));
    }
}

TEST_CASE("attitudes that some samples have are taken there, and lead to what is inferred between them") {
    TrackedAircraft aircraft = sampled(120, 1.0, [](double t) { return glm::dvec3(60.0 * t, 0.0, 900.0); });
    for (std::size_t i = 0; i < 120; i += 10) { aircraft.samples[i].roll_rad = 0.1; }
    const TrackMotion motion = motion_of(aircraft);
    CHECK(motion.inference.pitch_roll == Origin::Inferred); // none has both
    for (double time_s = 0.0; time_s <= 110.0; time_s += 2.5) {
        CHECK(euler_from_body_to_world(motion.trajectory.state_at(time_s).body_to_world).roll_rad ==
              Approx(0.1).margin(0.01));
    }
}

namespace {

/// Samples of a copter that hovers with its nose to the north and is tilted to the east and back by a sine.
TrackedAircraft swaying_copter() {
    constexpr double rate_radps = 0.9;
    TrackedAircraft aircraft =
        sampled(400, 0.2, [](double time_s) { return glm::dvec3(3.0 * std::sin(rate_radps * time_s), 0.0, 100.0); });
    aircraft.type = "Air+Rotorcraft";
    for (TrackSample& sample : aircraft.samples) { sample.heading_rad = 0.0; }
    return aircraft;
}

} // namespace

TEST_CASE("a rotor tilts by the measured heading, not by that of the way") {
    const TrackMotion motion = motion_of(swaying_copter());
    constexpr double rate_radps = 0.9;
    double most_roll_deg = 0.0;
    for (double time_s = 10.0; time_s < 70.0; time_s += 0.1) {
        const EulerAngles angles = euler_from_body_to_world(motion.trajectory.state_at(time_s).body_to_world);
        const double pull_mps2 = -3.0 * rate_radps * rate_radps * std::sin(rate_radps * time_s) +
                                 0.2 * 3.0 * rate_radps * std::cos(rate_radps * time_s); // and drag
        CHECK(deg_from_rad(angles.roll_rad) == Approx(deg_from_rad(std::atan(pull_mps2 / gravity_mps2))).margin(2.0));
        CHECK(std::abs(deg_from_rad(angles.pitch_rad)) < 1.0);
        most_roll_deg = std::max(most_roll_deg, deg_from_rad(angles.roll_rad));
    }
    CHECK(most_roll_deg > 10.0);
}

TEST_CASE("times that a recorder rounds to its clock bring no acceleration that was not there") {
    TrackedAircraft aircraft =
        sampled(600, 1.0 / 9.0, [](double time_s) { return glm::dvec3(250.0 * time_s, 0.0, 5000.0 - 80.0 * time_s); });
    for (TrackSample& sample : aircraft.samples) { sample.time_s = std::round(sample.time_s * 100.0) / 100.0; }
    const TrackMotion motion = motion_of(aircraft);
    for (double time_s = 3.0; time_s < 60.0; time_s += 0.1) {
        const sim::AircraftState state = motion.trajectory.state_at(time_s);
        const EulerAngles angles = euler_from_body_to_world(state.body_to_world);
        CHECK(std::abs(deg_from_rad(angles.roll_rad)) < 1.0);
        CHECK(std::abs(state.load_factor - 1.0) < 0.1);
    }
}

TEST_CASE("places whose stated errors are large count little") {
    TrackedAircraft aircraft = sampled(200, 1.0, [](double time_s) { return glm::dvec3(30.0 * time_s, 0.0, 500.0); });
    for (std::size_t i = 0; i < aircraft.samples.size(); ++i) {
        TrackSample& sample = aircraft.samples[i];
        const bool is_bad = i % 3 == 0;
        sample.horizontal_error_m = is_bad ? 20.0 : 1.0;
        sample.position_m.y += is_bad ? (i % 2 == 0 ? 9.0 : -9.0) : (i % 2 == 0 ? 0.3 : -0.3);
    }
    const TrackMotion motion = motion_of(aircraft);
    for (double time_s = 10.0; time_s < 180.0; time_s += 1.0) {
        CHECK(std::abs(motion.trajectory.state_at(time_s).position_m.y) < 1.0);
    }
}

TEST_CASE(
    "an aircraft that took off in a gap of its recording, or whose height drifted while parked, is no helicopter") {
    // Parked with heights that begin 20 m too high and drift to the right one, then a run at one height and flight.
    TrackedAircraft drifting = sampled(300, 1.0, [](double time_s) {
        const double run_s = std::max(0.0, time_s - 180.0);
        const double drift_m = std::max(0.0, 20.0 - time_s / 3.0);
        const double way_m = run_s < 30.0 ? run_s * run_s : 900.0 + 60.0 * (run_s - 30.0);
        return glm::dvec3(way_m, 0.0, 100.0 + drift_m + 5.0 * std::max(0.0, run_s - 30.0));
    });
    CHECK_FALSE(motion_of(drifting).inference.hovers);
    // Parked, no sample for five minutes, then in flight overhead.
    TrackedAircraft gap = sampled(200, 2.0, [](double time_s) {
        return time_s < 40.0 ? glm::dvec3(0.0, 0.0, 10.0) : glm::dvec3(100.0 * (time_s - 60.0), 0.0, 1500.0);
    });
    std::erase_if(gap.samples, [](const TrackSample& sample) { return sample.time_s > 40.0 && sample.time_s < 60.0; });
    for (TrackSample& sample : gap.samples) { sample.time_s += sample.time_s > 40.0 ? 280.0 : 0.0; }
    CHECK_FALSE(motion_of(gap).inference.hovers);
    // A paraglider that stands against the wind and climbs; without its type it may as well be a drone.
    TrackedAircraft against_wind = sampled(300, 1.0, [](double time_s) {
        const double away_m = 9.0 * std::max(0.0, time_s - 150.0);
        return glm::dvec3(away_m, 0.0, 800.0 + 1.5 * std::min(time_s, 150.0));
    });
    CHECK(motion_of(against_wind).inference.hovers);
    against_wind.type = "Air+Glider";
    CHECK_FALSE(motion_of(against_wind).inference.hovers);
}

TEST_CASE("an aircraft that is pushed back points against its way") {
    // 40 m back to the west, half a minute of rest, then forward to the east.
    const TrackedAircraft aircraft = sampled(260, 1.0, [](double time_s) {
        const double back_m = 40.0 * std::clamp((time_s - 20.0) / 30.0, 0.0, 1.0);
        return glm::dvec3(-back_m + 6.0 * std::max(0.0, time_s - 90.0), 0.0, 400.0);
    });
    const TrackMotion motion = motion_of(aircraft);
    for (const double time_s : {5.0, 30.0, 45.0, 70.0, 120.0}) {
        const EulerAngles angles = euler_from_body_to_world(motion.trajectory.state_at(time_s).body_to_world);
        CHECK(std::abs(wrapped_to_pi(angles.heading_rad - 0.5 * pi)) < 0.2);
    }
}

TEST_CASE("wind is found by circles, and the nose points through the air") {
    // Circles of 25 m/s through air that moves to the east at 8 m/s.
    const glm::dvec2 wind_mps(8.0, 0.0);
    const auto place_m = [&](double t) {
        const double angle = 0.25 * t;
        return glm::dvec3(100.0 * std::sin(angle) + wind_mps.x * t, -100.0 * std::cos(angle), 1500.0 + t);
    };
    const TrackMotion motion = motion_of(sampled(240, 1.0, place_m));
    REQUIRE_FALSE(motion.inference.winds.empty());
    for (const TrackInference::Wind& wind : motion.inference.winds) {
        CHECK(wind.from_circling);
        CHECK(glm::length(wind.wind_mps - wind_mps) < 0.5);
    }
    for (double time_s = 20.0; time_s < 220.0; time_s += 3.0) {
        const EulerAngles angles = euler_from_body_to_world(motion.trajectory.state_at(time_s).body_to_world);
        // To the left, as a coordinated turn of 25 m/s at 0.25 rad/s needs.
        CHECK(angles.roll_rad == Approx(-std::atan(25.0 * 0.25 / gravity_mps2)).margin(rad_from_deg(2.0)));
        CHECK(std::abs(wrapped_to_pi(angles.heading_rad - (0.5 * pi - 0.25 * time_s))) < rad_from_deg(3.0));
    }
}

TEST_CASE("wild places and repeated ones are not flown, and are counted") {
    TrackedAircraft aircraft = sampled(200, 1.0, [](double t) { return glm::dvec3(0.0, 40.0 * t, 500.0); });
    aircraft.samples[50].position_m.x = 400.0;
    aircraft.samples[120].position_m.z = 900.0;
    for (std::size_t i = 150; i < 160; i += 2) {
        aircraft.samples[i + 1].position_m.y = aircraft.samples[i].position_m.y;
        aircraft.samples[i + 1].position_m.x = aircraft.samples[i].position_m.x;
    }
    const TrackMotion motion = motion_of(aircraft);
    CHECK(motion.inference.rejected == 2);
    CHECK(motion.inference.repeated == 5);
    for (double time_s = 0.0; time_s < 199.0; time_s += 0.5) {
        const glm::dvec3 place_m = motion.trajectory.state_at(time_s).position_m;
        CHECK(glm::length(place_m - glm::dvec3(0.0, 40.0 * time_s, 500.0)) < 1.0);
    }
}

TEST_CASE("a flight from one standstill to another has its phases in order") {
    const GeneratedTrack track = generated_track("circuit", 3);
    const TrackMotion motion = motion_in(track.log);
    std::string order;
    for (const PhaseSpan& span : motion.inference.phases) { order += std::string(name_of(span.phase)) + ", "; }
    CHECK(order == "parked, taxi, take-off run, flight, landing run, taxi, parked, ");
    const TrackMotion hover = motion_in(generated_track("helicopter", 3).log);
    CHECK(hover.inference.hovers);
    CHECK(hover.inference.phases.front().phase == TrackPhase::Parked);
    CHECK(hover.inference.phases.back().phase == TrackPhase::Parked);
}

TEST_CASE("the parked aircraft of the found recordings is level and holds its heading") {
    const std::string file = std::string(OCTANT_SOURCE_DIR) + "/tests/flightpaths/tracks/parked.csv";
    const TrackRecording recording = parse_track_recording(read_file(file), file);
    const TrackMotion motion = motion_of(recording.aircraft.front());
    double heading_rad = 0.0;
    for (double time_s = 0.0; time_s < 55.0; time_s += 0.1) {
        const EulerAngles angles = euler_from_body_to_world(motion.trajectory.state_at(time_s).body_to_world);
        if (time_s == 0.0) { heading_rad = angles.heading_rad; }
        CHECK(std::abs(angles.pitch_rad) < rad_from_deg(2.0));
        CHECK(std::abs(angles.roll_rad) < rad_from_deg(2.0));
        CHECK(std::abs(wrapped_to_pi(angles.heading_rad - heading_rad)) < rad_from_deg(2.0));
    }
}
