#include "sim/trajectory.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

namespace octant::sim {

AircraftState state_between(const AircraftState& a, const AircraftState& b, double time_s) {
    const double span_s = b.time_s - a.time_s;
    const double u = (time_s - a.time_s) / span_s;
    const double u2 = u * u;
    const double u3 = u2 * u;
    AircraftState state;
    state.time_s = time_s;
    state.position_m = (2 * u3 - 3 * u2 + 1) * a.position_m + (u3 - 2 * u2 + u) * span_s * a.velocity_mps +
                       (3 * u2 - 2 * u3) * b.position_m + (u3 - u2) * span_s * b.velocity_mps;
    state.velocity_mps = (6 * u2 - 6 * u) / span_s * (a.position_m - b.position_m) +
                         (3 * u2 - 4 * u + 1) * a.velocity_mps + (3 * u2 - 2 * u) * b.velocity_mps;
    state.body_to_world = glm::normalize(glm::slerp(a.body_to_world, b.body_to_world, u));
    state.load_factor = (1 - u) * a.load_factor + u * b.load_factor;
    state.speed_rate_mps2 = (1 - u) * a.speed_rate_mps2 + u * b.speed_rate_mps2;
    state.turn_rate_radps = (1 - u) * a.turn_rate_radps + u * b.turn_rate_radps;
    return state;
}

glm::dvec3 turn_rate_radps(const AircraftState& a, const AircraftState& b) {
    const glm::dquat turn = glm::conjugate(a.body_to_world) * b.body_to_world;
    const glm::dvec3 half(turn.x, turn.y, turn.z);
    return (turn.w < 0.0 ? -2.0 : 2.0) / (b.time_s - a.time_s) * half;
}

namespace {

/// Half of the span over which the change of speed is measured: positions of recorded tracks are rounded, and between
/// two of their samples it is mostly noise.
constexpr double half_span_s = 0.5;

/// Calls `fill(sample, first, last)` for each sample with those at the ends of the span around it, its neighbours at
/// least.
template <typename Fill>
void fill_rates(std::vector<AircraftState>& samples, double half_s, const Fill& fill) {
    std::size_t first = 0;
    std::size_t last = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double now_s = samples[i].time_s;
        while (first + 1 < i && samples[first].time_s < now_s - half_s) { ++first; }
        last = std::max(last, std::min(i + 1, samples.size() - 1));
        while (last + 1 < samples.size() && samples[last + 1].time_s <= now_s + half_s) { ++last; }
        if (last > first) { fill(samples[i], samples[first], samples[last]); }
    }
}

void fill_speed_rates(std::vector<AircraftState>& samples) {
    for (AircraftState& sample : samples) { sample.speed_rate_mps2 = 0.0; }
    fill_rates(samples, half_span_s, [](AircraftState& sample, const AircraftState& first, const AircraftState& last) {
        const double gained_mps = glm::length(last.velocity_mps) - glm::length(first.velocity_mps);
        sample.speed_rate_mps2 = gained_mps / (last.time_s - first.time_s);
    });
}

void fill_turn_rates(std::vector<AircraftState>& samples) {
    constexpr double half_turn_span_s = 0.1;
    for (AircraftState& sample : samples) { sample.turn_rate_radps = glm::dvec3(0.0); }
    fill_rates(
        samples, half_turn_span_s, [](AircraftState& sample, const AircraftState& first, const AircraftState& last) {
            sample.turn_rate_radps = turn_rate_radps(first, last);
        });
}

} // namespace

Trajectory::Trajectory(std::vector<AircraftState> samples) : samples_(std::move(samples)) {
    fill_speed_rates(samples_);
    fill_turn_rates(samples_);
    assert(!samples_.empty());
    assert(std::adjacent_find(samples_.begin(), samples_.end(),
               [](const auto& a, const auto& b) { return !(a.time_s < b.time_s); }) == samples_.end());
}

AircraftState Trajectory::state_at(double time_s) const {
    const auto next = std::upper_bound(samples_.begin(), samples_.end(), time_s,
        [](double t, const AircraftState& sample) { return t < sample.time_s; });
    if (next == samples_.begin()) { return samples_.front(); }
    if (next == samples_.end()) { return samples_.back(); }
    const AircraftState& before = *(next - 1);
    return before.time_s == time_s ? before : state_between(before, *next, time_s);
}

} // namespace octant::sim
