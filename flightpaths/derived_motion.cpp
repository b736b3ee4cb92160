#include "flightpaths/derived_motion.h"

#include "sim/base/units.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

namespace octant::flightpaths {

sim::Trajectory reprojected(const sim::Trajectory& path, const EarthFrame& from, const EarthFrame& to) {
    const glm::dvec2 origin_m = to.local_from_geo(from.origin());
    const double stretch = to.origin().ellipsoid.semi_major_m / from.origin().ellipsoid.semi_major_m;
    std::vector<sim::AircraftState> samples(path.samples().begin(), path.samples().end());
    for (sim::AircraftState& state : samples) {
        const GeoPosition place = from.geo_from_local(glm::dvec2(state.position_m));
        const FramePosition there = to.place_of(place);
        const double turn_rad = there.north_bearing_rad - from.place_of(place).north_bearing_rad;
        const glm::dquat turn = glm::angleAxis(-turn_rad, glm::dvec3(0.0, 0.0, 1.0));
        state.position_m = glm::dvec3(there.east_north_m - origin_m, state.position_m.z);
        state.velocity_mps = turn * (state.velocity_mps * glm::dvec3(stretch, stretch, 1.0));
        state.body_to_world = glm::normalize(turn * state.body_to_world);
    }
    return sim::Trajectory(std::move(samples));
}

namespace {

/// Slope at time t of the parabola through three points of a member of the samples.
glm::dvec3 slope(
    const std::vector<sim::AircraftState>& samples, std::size_t at, glm::dvec3 sim::AircraftState::*member) {
    const std::size_t count = samples.size();
    if (count == 2) { return (samples[1].*member - samples[0].*member) / (samples[1].time_s - samples[0].time_s); }
    const std::size_t middle = std::clamp<std::size_t>(at, 1, count - 2);
    const sim::AircraftState& a = samples[middle - 1];
    const sim::AircraftState& b = samples[middle];
    const sim::AircraftState& c = samples[middle + 1];
    const double first_s = b.time_s - a.time_s;
    const double second_s = c.time_s - b.time_s;
    const glm::dvec3 before = (b.*member - a.*member) / first_s;
    const glm::dvec3 after = (c.*member - b.*member) / second_s;
    const glm::dvec3 bend = (after - before) / (first_s + second_s);
    const double from_middle_s = samples[at].time_s - b.time_s;
    return before + bend * (first_s + 2.0 * from_middle_s);
}

/// Acceleration that the aircraft feels: the change of its velocity without gravity.
glm::dvec3 felt_mps2(const std::vector<sim::AircraftState>& samples, std::size_t at) {
    return slope(samples, at, &sim::AircraftState::velocity_mps) + glm::dvec3(0.0, 0.0, gravity_mps2);
}

} // namespace

void fill_velocities(std::vector<sim::AircraftState>& samples) {
    assert(samples.size() >= 2);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i].velocity_mps = slope(samples, i, &sim::AircraftState::position_m);
    }
}

void fill_attitudes(std::vector<sim::AircraftState>& samples) {
    assert(samples.size() >= 2);
    glm::dvec3 forward(0.0, 1.0, 0.0);
    glm::dvec3 lift(0.0, 0.0, 1.0);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double speed_mps = glm::length(samples[i].velocity_mps);
        if (speed_mps > 0.1) { forward = samples[i].velocity_mps / speed_mps; }
        const glm::dvec3 felt = felt_mps2(samples, i);
        const glm::dvec3 across = felt - glm::dot(felt, forward) * forward;
        const glm::dvec3 kept = lift - glm::dot(lift, forward) * forward;
        if (glm::length(across) > 0.1 * gravity_mps2) {
            lift = glm::normalize(across);
        } else if (glm::length(kept) > 1e-6) {
            lift = glm::normalize(kept);
        } else {
            // Turned onto the old lift direction within one sample: any direction across will do.
            const glm::dvec3 any = glm::cross(forward, glm::dvec3(1.0, 0.0, 0.0));
            lift = glm::normalize(glm::length(any) > 1e-6 ? any : glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
        }
        const glm::dvec3 right = glm::cross(forward, lift);
        samples[i].body_to_world = glm::normalize(glm::quat_cast(glm::dmat3(forward, right, -lift)));
    }
}

void fill_load_factors(std::vector<sim::AircraftState>& samples) {
    assert(samples.size() >= 2);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const glm::dvec3 up = samples[i].body_to_world * glm::dvec3(0.0, 0.0, -1.0);
        samples[i].load_factor = glm::dot(felt_mps2(samples, i), up) / gravity_mps2;
    }
}

} // namespace octant::flightpaths
