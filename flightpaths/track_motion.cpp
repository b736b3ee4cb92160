#include "flightpaths/track_motion.h"

#include "flightpaths/derived_motion.h"
#include "flightpaths/track_steps.h"
#include "sim/aircraft_state.h"
#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>
#include <utility>

namespace octant::flightpaths {

const char* name_of(TrackPhase phase) {
    switch (phase) {
    case TrackPhase::Parked:
        return "parked";
    case TrackPhase::Taxi:
        return "taxi";
    case TrackPhase::TakeOffRun:
        return "take-off run";
    case TrackPhase::Flight:
        return "flight";
    case TrackPhase::Hover:
        return "hover";
    case TrackPhase::LandingRun:
        return "landing run";
    }
    return "";
}

namespace {

using Samples = std::span<const TrackSample>;

bool has_quaternion(const TrackSample& sample) { return glm::length(sample.body_to_world) > 0.5; }

template <class Has>
Origin origin_of(Samples samples, Has&& has) {
    const auto count = static_cast<std::size_t>(std::ranges::count_if(samples, has));
    return count == samples.size() ? Origin::Measured : count > 0 ? Origin::Partly : Origin::Inferred;
}

/// By its parts, or by speed and direction over the ground; climbs may be missing.
bool has_velocity(const TrackSample& sample) {
    return std::isfinite(sample.velocity_mps.x + sample.velocity_mps.y) ||
           std::isfinite(sample.ground_speed_mps + sample.track_rad);
}

bool has_whole_velocity(const TrackSample& sample) {
    return std::isfinite(sample.velocity_mps.x + sample.velocity_mps.y + sample.velocity_mps.z);
}

void note_origins(Samples samples, TrackInference& inference) {
    inference.velocity = origin_of(samples, has_velocity);
    inference.heading = origin_of(
        samples, [](const TrackSample& one) { return has_quaternion(one) || std::isfinite(one.heading_rad); });
    inference.pitch_roll = origin_of(samples,
        [](const TrackSample& one) { return has_quaternion(one) || std::isfinite(one.pitch_rad + one.roll_rad); });
}

void note_gaps(Samples samples, TrackInference& inference) {
    constexpr double least_s = 10.0;
    std::vector<double> steps_s;
    for (std::size_t i = 1; i < samples.size(); ++i) { steps_s.push_back(samples[i].time_s - samples[i - 1].time_s); }
    std::vector<double> sorted_s = steps_s;
    const auto middle = sorted_s.begin() + static_cast<std::ptrdiff_t>(sorted_s.size() / 2);
    std::ranges::nth_element(sorted_s, middle);
    for (const double step_s : steps_s) {
        if (step_s <= std::max(least_s, 4.0 * *middle)) { continue; }
        ++inference.gaps;
        inference.longest_gap_s = std::max(inference.longest_gap_s, step_s);
    }
}

sim::AircraftState recorded_state(const TrackSample& sample) {
    sim::AircraftState state;
    state.time_s = sample.time_s;
    state.position_m = sample.position_m;
    state.velocity_mps = sample.velocity_mps;
    state.body_to_world = has_quaternion(sample)
                              ? sample.body_to_world
                              : body_to_world_from_euler({sample.heading_rad, sample.pitch_rad, sample.roll_rad});
    return state;
}

void take_load_factors(Samples samples, std::vector<sim::AircraftState>& states) {
    const bool measured =
        std::ranges::all_of(samples, [](const TrackSample& one) { return std::isfinite(one.load_factor); });
    if (!measured || samples.size() != states.size()) {
        fill_load_factors(states);
        return;
    }
    for (std::size_t i = 0; i < states.size(); ++i) { states[i].load_factor = samples[i].load_factor; }
}

/// The path of states that are flown as they were recorded.
PathKinematics kinematics_of(const std::vector<sim::AircraftState>& states, Samples samples) {
    PathKinematics path;
    for (std::size_t i = 0; i < states.size(); ++i) {
        path.times_s.push_back(states[i].time_s);
        path.positions_m.push_back(states[i].position_m);
        path.velocities_mps.push_back(states[i].velocity_mps);
        path.contacts.push_back(samples[i].contact);
    }
    return path;
}

/// A recording with all attitudes.
TrackMotion recorded_motion(const TrackedAircraft& aircraft, TrackInference inference) {
    std::vector<sim::AircraftState> states;
    for (const TrackSample& sample : aircraft.samples) { states.push_back(recorded_state(sample)); }
    if (!std::ranges::all_of(aircraft.samples, has_whole_velocity)) { fill_velocities(states); }
    take_load_factors(aircraft.samples, states);
    const PathKinematics path = kinematics_of(states, aircraft.samples);
    const PathPhases phases = phases_of(path, aircraft.type);
    inference.hovers = phases.hovers;
    inference.phases = spans_of(phases.phases, path.times_s);
    return {sim::Trajectory(std::move(states)), std::move(inference), {}};
}

/// Between two samples that agree the contact is theirs.
void fill_contacts(const SmoothedPlaces& places, std::vector<GroundContact>& contacts) {
    std::size_t last = 0;
    for (std::size_t i = 1; i < contacts.size(); ++i) {
        if (places.samples[i] == SmoothedPlaces::no_sample) { continue; }
        if (contacts[i] == contacts[last]) {
            std::fill(contacts.begin() + static_cast<std::ptrdiff_t>(last),
                contacts.begin() + static_cast<std::ptrdiff_t>(i), contacts[i]);
        }
        last = i;
    }
}

PathKinematics kinematics_of(const SmoothedPlaces& places, Samples samples) {
    PathKinematics path;
    path.times_s = places.times_s;
    path.vertical_error_m = places.vertical_error_m;
    for (std::size_t i = 0; i < places.times_s.size(); ++i) {
        path.positions_m.push_back(places.position_m(i));
        path.velocities_mps.push_back(places.velocity_mps(i));
        path.accelerations_mps2.push_back(places.acceleration_mps2(i));
        const std::size_t sample = places.samples[i];
        path.filled.push_back(sample == SmoothedPlaces::no_sample);
        path.contacts.push_back(sample == SmoothedPlaces::no_sample ? GroundContact::Unknown : samples[sample].contact);
    }
    fill_contacts(places, path.contacts);
    return path;
}

/// Values of the samples at the times of a path.
std::vector<double> at_times(const SmoothedPlaces& places, Samples samples, double TrackSample::*member) {
    std::vector<double> values;
    for (const std::size_t sample : places.samples) {
        values.push_back(sample == SmoothedPlaces::no_sample ? not_measured : samples[sample].*member);
    }
    return values;
}

WindEstimate wind_of(const SmoothedPlaces& places, const PathKinematics& path, Samples samples) {
    AirData air{path.times_s, path.velocities_mps, at_times(places, samples, &TrackSample::true_airspeed_mps),
        at_times(places, samples, &TrackSample::heading_rad)};
    return WindEstimate(air);
}

std::vector<bool> parked_of(const PathPhases& phases) {
    std::vector<bool> parked;
    for (const TrackPhase phase : phases.phases) { parked.push_back(phase == TrackPhase::Parked); }
    return parked;
}

std::vector<sim::AircraftState> states_of(const PathKinematics& path, const std::vector<EulerAngles>& attitudes) {
    std::vector<sim::AircraftState> states;
    for (std::size_t i = 0; i < path.times_s.size(); ++i) {
        sim::AircraftState state;
        state.time_s = path.times_s[i];
        state.position_m = path.positions_m[i];
        state.velocity_mps = path.velocities_mps[i];
        state.body_to_world = body_to_world_from_euler(attitudes[i]);
        const glm::dvec3 up = state.body_to_world * glm::dvec3(0.0, 0.0, -1.0);
        const glm::dvec3 felt = path.accelerations_mps2[i] + glm::dvec3(0.0, 0.0, gravity_mps2);
        state.load_factor = glm::dot(felt, up) / gravity_mps2;
        states.push_back(state);
    }
    return states;
}

/// The mean wind of a track, as a weather report gives it.
std::string wind_text(const TrackInference& inference) {
    if (inference.winds.empty()) { return " without wind"; }
    glm::dvec2 sum_mps(0.0);
    for (const TrackInference::Wind& wind : inference.winds) { sum_mps += wind.wind_mps; }
    const glm::dvec2 wind_mps = sum_mps / static_cast<double>(inference.winds.size());
    const double from_deg = deg_from_rad(wrapped_to_two_pi(std::atan2(-wind_mps.x, -wind_mps.y)));
    const bool circling = std::ranges::all_of(inference.winds, &TrackInference::Wind::from_circling);
    return fmt::format(" with a wind of {:.0f} m/s from {:03.0f} degrees, found by {}", glm::length(wind_mps), from_deg,
        circling ? "its circles" : "its airspeeds and headings");
}

/// What a person should know of a motion that is not as recorded.
std::vector<std::string> notes_of(const TrackInference& inference) {
    std::vector<std::string> what;
    if (inference.heading != Origin::Measured) { what.emplace_back("heading"); }
    if (inference.pitch_roll != Origin::Measured) { what.emplace_back("pitch and roll"); }
    std::vector<std::string> parts;
    parts.push_back(fmt::format("{} {} inferred from the motion{}", fmt::join(what, ", "),
        what.size() == 1 && what.front() == "heading" ? "is" : "are", wind_text(inference)));
    constexpr double told_m = 0.05;
    if (inference.horizontal_error_m > told_m || inference.vertical_error_m > told_m) {
        parts.push_back(fmt::format("places are smoothed within {:.1f} m, heights within {:.1f} m{}",
            inference.horizontal_error_m, inference.vertical_error_m,
            inference.height_step_m > 0.0 ? fmt::format(" (they come in steps of {:.2f} m)", inference.height_step_m)
                                          : ""));
    }
    if (inference.rejected > 0) {
        parts.push_back(fmt::format("{} that contradict all others are left out", inference.rejected));
    }
    if (inference.repeated > 0) {
        parts.push_back(fmt::format("{} repeat the place before while it moves and are left out", inference.repeated));
    }
    return {fmt::format("{}", fmt::join(parts, "; "))};
}

} // namespace

TrackMotion motion_of(const TrackedAircraft& aircraft) {
    TrackInference inference;
    note_origins(aircraft.samples, inference);
    note_gaps(aircraft.samples, inference);
    if (inference.heading == Origin::Measured && inference.pitch_roll == Origin::Measured) {
        return recorded_motion(aircraft, std::move(inference));
    }
    PlaceSmoother smoother(aircraft.samples);
    PathKinematics path = kinematics_of(smoother.places(), aircraft.samples);
    const PathPhases phases = phases_of(path, aircraft.type);
    smoother.hold_at_rest(parked_of(phases));
    const SmoothedPlaces& places = smoother.places();
    path = kinematics_of(places, aircraft.samples);
    const WindEstimate wind = wind_of(places, path, aircraft.samples);
    std::vector<EulerAngles> attitudes =
        inferred_attitudes(path, phases, wind, at_times(places, aircraft.samples, &TrackSample::heading_rad));
    take_measured(
        path.times_s, at_times(places, aircraft.samples, &TrackSample::pitch_rad), &EulerAngles::pitch_rad, attitudes);
    take_measured(
        path.times_s, at_times(places, aircraft.samples, &TrackSample::roll_rad), &EulerAngles::roll_rad, attitudes);
    inference.horizontal_error_m = places.horizontal_error_m;
    inference.vertical_error_m = places.vertical_error_m;
    inference.height_step_m = places.height_step_m;
    inference.rejected = places.rejected;
    inference.repeated = places.repeated;
    inference.hovers = phases.hovers;
    inference.phases = spans_of(phases.phases, path.times_s);
    inference.winds = wind.winds();
    auto notes = notes_of(inference);
    return {sim::Trajectory(states_of(path, attitudes)), std::move(inference), std::move(notes)};
}

} // namespace octant::flightpaths
