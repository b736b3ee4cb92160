#include "sim/trajectory.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace octant::sim {

AircraftState state_between(const AircraftState& a, const AircraftState& b, double time_s) {
    const double span_s = b.time_s - a.time_s;
    const double u = (time_s - a.time_s) / span_s;
    const double u2 = u * u;
    const double u3 = u2 * u;
    AircraftState state;
    state.time_s = time_s;
    state.position_m = (2 * u3 - 3 * u2 + 1) * a.position_m +
                       (u3 - 2 * u2 + u) * span_s * a.velocity_mps +
                       (3 * u2 - 2 * u3) * b.position_m + (u3 - u2) * span_s * b.velocity_mps;
    state.velocity_mps = (6 * u2 - 6 * u) / span_s * (a.position_m - b.position_m) +
                         (3 * u2 - 4 * u + 1) * a.velocity_mps + (3 * u2 - 2 * u) * b.velocity_mps;
    state.body_to_world = glm::normalize(glm::slerp(a.body_to_world, b.body_to_world, u));
    state.load_factor = (1 - u) * a.load_factor + u * b.load_factor;
    return state;
}

Trajectory::Trajectory(std::vector<AircraftState> samples)
    : samples_(std::move(samples)) {
    assert(!samples_.empty());
    assert(std::adjacent_find(samples_.begin(), samples_.end(), [](const auto& a, const auto& b) {
               return !(a.time_s < b.time_s);
           }) == samples_.end());
}

AircraftState Trajectory::state_at(double time_s) const {
    const auto next = std::upper_bound(
        samples_.begin(), samples_.end(), time_s, [](double t, const AircraftState& sample) {
            return t < sample.time_s;
        });
    if (next == samples_.begin()) {
        return samples_.front();
    }
    if (next == samples_.end()) {
        return samples_.back();
    }
    const AircraftState& before = *(next - 1);
    return before.time_s == time_s ? before : state_between(before, *next, time_s);
}

} // namespace octant::sim
