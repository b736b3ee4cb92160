// An upper envelope of the ground along a path. Our own method: running maximum, two sweeps that
// limit the slope, then a moving mean taken twice. The mean at a step is taken over values none of
// which is below the need at that step, so it cannot fall below it; and a moving mean keeps slopes
// and bounds the curvature by (slope up + slope down) / window.

#include "flightpaths/ground_follow.h"

#include "sim/base/units.h"
#include "sim/fixed_step.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

namespace octant::flightpaths {

namespace {

constexpr double steepest = 0.25;
/// How far beyond the path's own load factor the lift may always go, g.
constexpr double small_change_g = 0.1;
constexpr std::array<double, 9> half_windows_s{0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0, 16.0};

struct Lift {
    std::vector<double> height_m;
    std::vector<double> rate_mps;
    std::vector<double> acceleration_mps2;
};

/// Largest value within `half` places to either side; the ends are repeated.
std::vector<double> running_max(const std::vector<double>& values, std::size_t half) {
    std::vector<double> most(values.size());
    std::deque<std::size_t> falling;
    std::size_t next = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (; next < std::min(values.size(), i + half + 1); ++next) {
            while (!falling.empty() && values[falling.back()] <= values[next]) {
                falling.pop_back();
            }
            falling.push_back(next);
        }
        while (falling.front() + half < i) {
            falling.pop_front();
        }
        most[i] = values[falling.front()];
    }
    return most;
}

std::vector<double> running_min(std::vector<double> values, std::size_t half) {
    for (double& value : values) {
        value = -value;
    }
    values = running_max(values, half);
    for (double& value : values) {
        value = -value;
    }
    return values;
}

/// Means over `half` places to either side, for the places that have them: 2 * half fewer values.
std::vector<double> running_mean(const std::vector<double>& values, std::size_t half) {
    const std::size_t width = 2 * half + 1;
    std::vector<double> means;
    means.reserve(values.size() - 2 * half);
    // Sums of differences to the first value keep a level profile exactly level.
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum += values[i] - values.front();
        if (i >= width) {
            sum -= values[i - width] - values.front();
        }
        if (i + 1 >= width) {
            means.push_back(values.front() + sum / static_cast<double>(width));
        }
    }
    return means;
}

std::vector<double> padded(const std::vector<double>& values, std::size_t by) {
    std::vector<double> out(by, values.front());
    out.insert(out.end(), values.begin(), values.end());
    out.insert(out.end(), by, values.back());
    return out;
}

/// Most that the lift may rise and fall in each step, m.
struct Slopes {
    std::vector<double> up_m;
    std::vector<double> down_m;
};

Slopes slopes_along(const sim::Trajectory& path, std::size_t steps, double climb_mps) {
    Slopes slopes;
    for (std::size_t i = 0; i < steps; ++i) {
        const double time_s = path.start_s() + static_cast<double>(i) * sim::step_s;
        const glm::dvec3 now = path.state_at(time_s).velocity_mps;
        const glm::dvec3 next = path.state_at(time_s + sim::step_s).velocity_mps;
        const double speed_mps = glm::length(now);
        const double gain_mps2 = (glm::length(next) - speed_mps) / sim::step_s;
        const double spent_mps = std::max(0.0, now.z + speed_mps * gain_mps2 / gravity_mps2);
        const double max_mps = std::min(climb_mps, steepest * speed_mps);
        slopes.up_m.push_back(std::clamp(climb_mps - spent_mps, 0.0, max_mps) * sim::step_s);
        slopes.down_m.push_back(max_mps * sim::step_s);
    }
    return slopes;
}

Lift rounded_lift(const std::vector<double>& needed_m, const Slopes& slopes, std::size_t half) {
    // Two means reach 2 * half to either side; one more for the slopes at the ends.
    const std::size_t pad = 2 * half + 1;
    const std::vector<double> envelope = slope_limited(
        running_max(padded(needed_m, pad), 2 * half),
        running_min(padded(slopes.up_m, pad), 2 * half),
        running_min(padded(slopes.down_m, pad), 2 * half));
    const std::vector<double> smooth = running_mean(running_mean(envelope, half), half);
    Lift lift;
    for (std::size_t i = 1; i + 1 < smooth.size(); ++i) {
        lift.height_m.push_back(smooth[i]);
        lift.rate_mps.push_back((smooth[i + 1] - smooth[i - 1]) / (2.0 * sim::step_s));
        lift.acceleration_mps2.push_back(
            (smooth[i + 1] - 2.0 * smooth[i] + smooth[i - 1]) / (sim::step_s * sim::step_s));
    }
    return lift;
}

Lift level_lift(const std::vector<double>& needed_m) {
    const double max_m = *std::max_element(needed_m.begin(), needed_m.end());
    const std::vector<double> zeros(needed_m.size(), 0.0);
    return {std::vector<double>(needed_m.size(), max_m), zeros, zeros};
}

bool is_level(const Lift& lift) {
    const auto [low, high] = std::minmax_element(lift.height_m.begin(), lift.height_m.end());
    return *low == *high;
}

double at_step(const std::vector<double>& values, double step) {
    const double last = static_cast<double>(values.size() - 1);
    const double inside = std::clamp(step, 0.0, last);
    const auto i = static_cast<std::size_t>(inside);
    const std::size_t next = std::min(i + 1, values.size() - 1);
    const double share = inside - static_cast<double>(i);
    return (1.0 - share) * values[i] + share * values[next];
}

sim::AircraftState lifted(const sim::AircraftState& state, const Lift& lift, double step) {
    sim::AircraftState out = state;
    out.position_m.z += at_step(lift.height_m, step);
    out.velocity_mps.z += at_step(lift.rate_mps, step);
    const double before_mps = glm::length(state.velocity_mps);
    const double after_mps = glm::length(out.velocity_mps);
    if (before_mps > 0.1 && after_mps > 0.1) {
        const glm::dquat turn =
            glm::dquat(state.velocity_mps / before_mps, out.velocity_mps / after_mps);
        out.body_to_world = glm::normalize(turn * state.body_to_world);
    }
    const glm::dvec3 up = state.body_to_world * glm::dvec3(0.0, 0.0, -1.0);
    out.load_factor += at_step(lift.acceleration_mps2, step) * up.z / gravity_mps2;
    return out;
}

double step_of(const sim::Trajectory& path, double time_s) {
    return (time_s - path.start_s()) * sim::steps_per_second;
}

bool within(const sim::Trajectory& path, const Lift& lift, const sim::AircraftLimits& limits) {
    const double half_max = 0.5 * (1.0 + limits.max_load_factor);
    const double half_min = 0.5 * (1.0 + limits.min_load_factor);
    for (const sim::AircraftState& state : path.samples()) {
        const double own = state.load_factor;
        const double most = std::min(
            std::max(half_max, own + small_change_g), std::max(limits.max_load_factor, own));
        const double least = std::max(
            std::min(half_min, own - small_change_g), std::min(limits.min_load_factor, own));
        const double got = lifted(state, lift, step_of(path, state.time_s)).load_factor;
        if (got > most + 1e-9 || got < least - 1e-9) {
            return false;
        }
    }
    const double onset_mps3 = limits.load_factor_rate_gps * gravity_mps2;
    for (std::size_t i = 1; i < lift.acceleration_mps2.size(); ++i) {
        const double change = lift.acceleration_mps2[i] - lift.acceleration_mps2[i - 1];
        if (std::abs(change) > onset_mps3 * sim::step_s) {
            return false;
        }
    }
    return true;
}

} // namespace

std::vector<double> slope_limited(
    std::vector<double> needed_m,
    const std::vector<double>& up_m,
    const std::vector<double>& down_m) {
    assert(needed_m.size() == up_m.size() && needed_m.size() == down_m.size());
    for (std::size_t i = needed_m.size() - 1; i > 0; --i) {
        needed_m[i - 1] = std::max(needed_m[i - 1], needed_m[i] - up_m[i - 1]);
    }
    for (std::size_t i = 1; i < needed_m.size(); ++i) {
        needed_m[i] = std::max(needed_m[i], needed_m[i - 1] - down_m[i - 1]);
    }
    return needed_m;
}

RaisedPath raised_over_ground(
    const sim::Trajectory& path,
    const std::vector<double>& needed_m,
    const sim::AircraftLimits& limits) {
    assert(!needed_m.empty());
    const Slopes slopes = slopes_along(path, needed_m.size(), limits.climb_rate_mps);
    Lift lift = level_lift(needed_m);
    bool refused = false;
    for (const double half_s : half_windows_s) {
        const auto half = static_cast<std::size_t>(half_s * sim::steps_per_second);
        Lift tried = rounded_lift(needed_m, slopes, half);
        if (within(path, tried, limits)) {
            lift = std::move(tried);
            break;
        }
        refused = true;
    }
    std::vector<sim::AircraftState> samples;
    for (const sim::AircraftState& state : path.samples()) {
        samples.push_back(lifted(state, lift, step_of(path, state.time_s)));
    }
    return {sim::Trajectory(std::move(samples)), !refused || !is_level(lift)};
}

} // namespace octant::flightpaths
