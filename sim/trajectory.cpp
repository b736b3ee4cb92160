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
    return state;
}

namespace {

/// Half of the span over which the change of speed is measured: positions of recorded tracks are rounded, and between
/// two of their samples it is mostly noise.
constexpr double half_span_s = 0.5;

/// The change of speed at each sample, from the samples within half_span_s, its neighbours at least.
void fill_speed_rates(std::vector<AircraftState>& samples) {
    std::size_t first = 0;
    std::size_t last = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double now_s = samples[i].time_s;
        while (first + 1 < i && samples[first].time_s < now_s - half_span_s) { ++first; }
        last = std::max(last, std::min(i + 1, samples.size() - 1));
        while (last + 1 < samples.size() && samples[last + 1].time_s <= now_s + half_span_s) { ++last; }
        const double span_s = samples[last].time_s - samples[first].time_s;
        const double gained_mps = glm::length(samples[last].velocity_mps) - glm::length(samples[first].velocity_mps);
        samples[i].speed_rate_mps2 = span_s > 0.0 ? gained_mps / span_s : 0.0;
    }
}

} // namespace

Trajectory::Trajectory(std::vector<AircraftState> samples) : samples_(std::move(samples)) {
    fill_speed_rates(samples_);
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
