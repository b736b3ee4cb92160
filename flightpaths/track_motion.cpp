#include "flightpaths/track_motion.h"

#include "flightpaths/derived_motion.h"
#include "sim/aircraft_state.h"
#include "sim/base/axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace octant::flightpaths {

namespace {

bool has_velocity(const TrackSample& sample) {
    return !std::isnan(sample.velocity_mps.x + sample.velocity_mps.y + sample.velocity_mps.z);
}

bool has_quaternion(const TrackSample& sample) { return sample.body_to_world != glm::dquat(0.0, 0.0, 0.0, 0.0); }

bool has_roll_and_pitch(const TrackSample& sample) { return !std::isnan(sample.roll_rad + sample.pitch_rad); }

bool has_load_factor(const TrackSample& sample) { return !std::isnan(sample.load_factor); }

} // namespace

const char* name_of(TrackPhase phase) {
    constexpr std::array names{"parked", "taxi", "take-off run", "flight", "hover", "landing run"};
    return names.at(static_cast<std::size_t>(phase));
}

TrackMotion motion_of(const TrackedAircraft& aircraft) {
    const std::vector<TrackSample>& samples = aircraft.samples;
    std::vector<sim::AircraftState> states(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        states[i].time_s = samples[i].time_s;
        states[i].position_m = samples[i].position_m;
        states[i].velocity_mps = samples[i].velocity_mps;
    }
    if (!std::ranges::all_of(samples, has_velocity)) { fill_velocities(states); }
    const bool has_quaternions = std::ranges::all_of(samples, has_quaternion);
    if (!has_quaternions) { fill_attitudes(states); }
    const bool has_angles = std::ranges::all_of(samples, has_roll_and_pitch);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (has_quaternions) {
            states[i].body_to_world = samples[i].body_to_world;
        } else if (has_angles) {
            const double flown_rad = euler_from_body_to_world(states[i].body_to_world).heading_rad;
            states[i].body_to_world =
                body_to_world_from_euler({std::isnan(samples[i].heading_rad) ? flown_rad : samples[i].heading_rad,
                    samples[i].pitch_rad, samples[i].roll_rad});
        }
    }
    if (std::ranges::all_of(samples, has_load_factor)) {
        for (std::size_t i = 0; i < samples.size(); ++i) { states[i].load_factor = samples[i].load_factor; }
    } else {
        fill_load_factors(states);
    }
    TrackInference inference;
    inference.velocity = std::ranges::all_of(samples, has_velocity) ? Origin::Measured : Origin::Inferred;
    inference.pitch_roll = has_quaternions || has_angles ? Origin::Measured : Origin::Inferred;
    inference.heading = inference.pitch_roll;
    return {sim::Trajectory(std::move(states)), std::move(inference), {}};
}

} // namespace octant::flightpaths
