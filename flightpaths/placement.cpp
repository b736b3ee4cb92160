#include "flightpaths/placement.h"

#include "flightpaths/height_envelope.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "sim/flight_steps.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace octant::flightpaths {

// An upper envelope of the ground along a path. Our own method: running maximum, two sweeps that limit the slope, then
// a moving mean taken twice. The mean at a step is taken over values none of which is below the need at that step, so
// it cannot fall below it; and a moving mean keeps slopes and bounds the curvature by (slope up + slope down) / window.

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
    const std::vector<double> envelope = slope_limited(running_max(padded(needed_m, pad), 2 * half),
        running_min(padded(slopes.up_m, pad), 2 * half), running_min(padded(slopes.down_m, pad), 2 * half));
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
        const glm::dquat turn = glm::dquat(state.velocity_mps / before_mps, out.velocity_mps / after_mps);
        out.body_to_world = glm::normalize(turn * state.body_to_world);
    }
    const glm::dvec3 up = state.body_to_world * glm::dvec3(0.0, 0.0, -1.0);
    out.load_factor += at_step(lift.acceleration_mps2, step) * up.z / gravity_mps2;
    return out;
}

double step_of(const sim::Trajectory& path, double time_s) { return (time_s - path.start_s()) * sim::steps_per_second; }

bool within(const sim::Trajectory& path, const Lift& lift, const sim::AircraftLimits& limits) {
    const double half_max = 0.5 * (1.0 + limits.max_load_factor);
    const double half_min = 0.5 * (1.0 + limits.min_load_factor);
    for (const sim::AircraftState& state : path.samples()) {
        const double own = state.load_factor;
        const double max = std::min(std::max(half_max, own + small_change_g), std::max(limits.max_load_factor, own));
        const double min = std::max(std::min(half_min, own - small_change_g), std::min(limits.min_load_factor, own));
        const double got = lifted(state, lift, step_of(path, state.time_s)).load_factor;
        if (got > max + 1e-9 || got < min - 1e-9) { return false; }
    }
    const double onset_mps3 = limits.load_factor_rate_gps * gravity_mps2;
    for (std::size_t i = 1; i < lift.acceleration_mps2.size(); ++i) {
        const double change = lift.acceleration_mps2[i] - lift.acceleration_mps2[i - 1];
        if (std::abs(change) > onset_mps3 * sim::step_s) { return false; }
    }
    return true;
}

} // namespace

std::vector<double> slope_limited(
    std::vector<double> needed_m, const std::vector<double>& up_m, const std::vector<double>& down_m) {
    assert(needed_m.size() == up_m.size() && needed_m.size() == down_m.size());
    for (std::size_t i = needed_m.size() - 1; i > 0; --i) {
        needed_m[i - 1] = std::max(needed_m[i - 1], needed_m[i] - up_m[i - 1]);
    }
    for (std::size_t i = 1; i < needed_m.size(); ++i) {
        needed_m[i] = std::max(needed_m[i], needed_m[i - 1] - down_m[i - 1]);
    }
    return needed_m;
}

namespace {

struct RaisedPath {
    sim::Trajectory trajectory;
    /// False if only one lift for all heights is within the limits.
    bool follows = true;
};

/// Lifts a path over ground, changing in time.
///
/// `needed_m` is what must at least be added to the path's height at each step of sim::step_s from its start; the
/// result adds at least that at every step. The aircraft climbs no faster than it can in addition to the path's own
/// climb, sinks no faster than it can climb, and both no steeper than 1 in 4. The lift is rounded over the shortest
/// time that keeps the load factor within half of the aircraft's margins (or near the path's own, if that is beyond
/// them) and its onset within the limit. If no time does, or only one that levels the whole path, the path is lifted by
/// one height and `follows` is false.
///
/// Speed along the ground stays; velocity, pitch and load factor follow the new path; bank stays.
RaisedPath raised_over_ground(
    const sim::Trajectory& path, const std::vector<double>& needed_m, const sim::AircraftLimits& limits) {
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

constexpr int headings = 24;
/// Reliefs closer than this count as equal, so that rounding does not choose.
constexpr double same_relief_m = 1e-6;
/// A clearance of no more than this is contact, for the same reason.
constexpr double contact_m = 1e-6;

/// The times of all steps of a path between two times, and of the last one of these.
std::vector<double> step_times(const sim::Trajectory& path, double from_s = -std::numeric_limits<double>::infinity(),
    double to_s = std::numeric_limits<double>::infinity()) {
    const double skipped_s = std::clamp(from_s - path.start_s(), 0.0, path.end_s() - path.start_s());
    const double duration_s = std::clamp(to_s - path.start_s(), skipped_s, path.end_s() - path.start_s());
    const long first = static_cast<long>(std::floor(skipped_s * sim::steps_per_second + 1e-6));
    const long steps = static_cast<long>(std::ceil(duration_s * sim::steps_per_second - 1e-6));
    std::vector<double> times_s;
    for (long step = first; step <= steps; ++step) {
        times_s.push_back(path.start_s() + std::min(duration_s, sim::time_of_step(step)));
    }
    return times_s;
}

std::vector<glm::dvec3> places_along(const sim::Trajectory& path, const std::vector<double>& times_s) {
    std::vector<glm::dvec3> places_m;
    places_m.reserve(times_s.size());
    for (const double time_s : times_s) { places_m.push_back(path.state_at(time_s).position_m); }
    return places_m;
}

glm::dquat turn_by(double heading_rad) { return glm::angleAxis(-heading_rad, glm::dvec3(0.0, 0.0, 1.0)); }

std::string where(double time_s, const glm::dvec3& place_m) {
    return fmt::format("t = {:.1f} s, x = {:.1f}, y = {:.1f} m", time_s, place_m.x, place_m.y);
}

/// Ground along a path, or where it leaves the map.
struct GroundTrack {
    std::vector<double> heights_m;
    /// The index of the first place without ground.
    std::optional<std::size_t> leaves_at;
};

GroundTrack ground_along(const std::vector<glm::dvec3>& places_m, const GroundHeight& ground) {
    GroundTrack track;
    track.heights_m.reserve(places_m.size());
    for (std::size_t i = 0; i < places_m.size(); ++i) {
        const auto height_m = ground(places_m[i].x, places_m[i].y);
        if (!height_m || !std::isfinite(*height_m)) {
            track.leaves_at = i;
            return track;
        }
        track.heights_m.push_back(*height_m);
    }
    return track;
}

/// Heights of the ground along a path; throws where it leaves the map.
std::vector<double> heights_on_map(
    const std::vector<double>& times_s, const std::vector<glm::dvec3>& places_m, const GroundHeight& ground) {
    GroundTrack track = ground_along(places_m, ground);
    if (track.leaves_at) {
        throw OutsideMapError("path leaves the map at " + where(times_s[*track.leaves_at], places_m[*track.leaves_at]));
    }
    return std::move(track.heights_m);
}

/// Far below everything.
constexpr double no_ground_m = -1e9;

/// Heights of the ground along a path, no_ground_m beside the map; throws where all of it is beside the map.
std::vector<double> heights_where_known(
    const std::vector<double>& times_s, const std::vector<glm::dvec3>& places_m, const GroundHeight& ground) {
    std::vector<double> heights_m;
    for (const glm::dvec3& place_m : places_m) {
        const auto height_m = ground(place_m.x, place_m.y);
        heights_m.push_back(height_m && std::isfinite(*height_m) ? *height_m : no_ground_m);
    }
    if (std::ranges::all_of(heights_m, [](double height_m) { return height_m == no_ground_m; })) {
        throw OutsideMapError("path is beside the map from " + where(times_s.front(), places_m.front()) + " on");
    }
    return heights_m;
}

std::vector<glm::dvec3> turned(
    const std::vector<glm::dvec3>& places_m, double heading_rad, const glm::dvec2& origin_m) {
    const glm::dquat turn = turn_by(heading_rad);
    std::vector<glm::dvec3> out;
    out.reserve(places_m.size());
    for (const glm::dvec3& place : places_m) { out.push_back(turn * place + glm::dvec3(origin_m, 0.0)); }
    return out;
}

struct Choice {
    double heading_rad = 0.0;
    glm::dvec2 origin_m{0.0};
};

/// The heading of least height difference on the ground; nothing when every heading leaves the map.
std::optional<Choice> min_relief(const std::vector<glm::dvec3>& places_m, const glm::dvec2& pivot_m,
    const glm::dvec2& place_m, const GroundHeight& ground) {
    std::optional<Choice> best;
    double best_relief_m = std::numeric_limits<double>::infinity();
    for (int candidate = 0; candidate < headings; ++candidate) {
        const double heading_rad = 2.0 * pi * candidate / headings;
        const glm::dvec2 origin_m = place_m - glm::dvec2(turn_by(heading_rad) * glm::dvec3(pivot_m, 0.0));
        const GroundTrack track = ground_along(turned(places_m, heading_rad, origin_m), ground);
        if (track.leaves_at) { continue; }
        const auto [low, high] = std::minmax_element(track.heights_m.begin(), track.heights_m.end());
        if (*high - *low < best_relief_m - same_relief_m) {
            best_relief_m = *high - *low;
            best = Choice{heading_rad, origin_m};
        }
    }
    return best;
}

glm::dvec2 middle_of(const std::vector<glm::dvec3>& places_m) {
    glm::dvec3 low = places_m.front();
    glm::dvec3 high = low;
    for (const glm::dvec3& place : places_m) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    return glm::dvec2(0.5 * (low + high));
}

Choice chosen(const std::vector<glm::dvec3>& places_m, const std::vector<double>& times_s,
    const PlacementOptions& placement, const GroundHeight& ground) {
    if (placement.heading_rad) { return {wrapped_to_two_pi(*placement.heading_rad), placement.place_m}; }
    auto best = min_relief(places_m, glm::dvec2(0.0), placement.place_m, ground);
    if (!best) { best = min_relief(places_m, middle_of(places_m), placement.place_m, ground); }
    if (best) { return *best; }
    const auto as_is = turned(places_m, 0.0, placement.place_m);
    const std::size_t at = ground_along(as_is, ground).leaves_at.value_or(0);
    throw OutsideMapError(
        fmt::format("path leaves the map at every heading, with heading 0 at {}", where(times_s[at], as_is[at])));
}

sim::Trajectory moved(const sim::Trajectory& path, const Choice& choice) {
    const glm::dquat turn = turn_by(choice.heading_rad);
    std::vector<sim::AircraftState> samples(path.samples().begin(), path.samples().end());
    for (sim::AircraftState& state : samples) {
        state.position_m = turn * state.position_m + glm::dvec3(choice.origin_m, 0.0);
        state.velocity_mps = turn * state.velocity_mps;
        state.body_to_world = glm::normalize(turn * state.body_to_world);
    }
    return sim::Trajectory(std::move(samples));
}

sim::Trajectory raised(const sim::Trajectory& path, double by_m) {
    std::vector<sim::AircraftState> samples(path.samples().begin(), path.samples().end());
    for (sim::AircraftState& state : samples) { state.position_m.z += by_m; }
    return sim::Trajectory(std::move(samples));
}

struct Lowest {
    double clearance_m = 0.0;
    std::size_t step = 0;
};

Lowest lowest_of(const std::vector<glm::dvec3>& places_m, const std::vector<double>& ground_heights_m) {
    Lowest lowest{places_m.front().z - ground_heights_m.front(), 0};
    for (std::size_t i = 1; i < places_m.size(); ++i) {
        const double clearance_m = places_m[i].z - ground_heights_m[i];
        if (clearance_m < lowest.clearance_m) { lowest = {clearance_m, i}; }
    }
    return lowest;
}

/// Throws where a path meets the ground.
void check_clear(const std::vector<double>& times_s, const std::vector<glm::dvec3>& places_m,
    const std::vector<double>& ground_heights_m) {
    const double clearance_m = lowest_of(places_m, ground_heights_m).clearance_m;
    if (clearance_m > contact_m) { return; }
    std::size_t first = 0;
    while (first + 1 < places_m.size() && places_m[first].z - ground_heights_m[first] > contact_m) { ++first; }
    throw Error(fmt::format("path meets the ground at {}, and is {:.1f} m below it at its lowest",
        where(times_s[first], places_m[first]), std::max(0.0, -clearance_m)));
}

double min_added_m(const sim::Trajectory& before, const sim::Trajectory& after) {
    double min_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < before.samples().size(); ++i) {
        min_m = std::min(min_m, after.samples()[i].position_m.z - before.samples()[i].position_m.z);
    }
    return min_m;
}

RaisedPath following(const sim::Trajectory& path, const std::vector<glm::dvec3>& places_m,
    const std::vector<double>& ground_heights_m, double min_clearance_m, const sim::AircraftLimits& limits) {
    // Heights of the path are heights over the ground, never less than the clearance.
    std::vector<double> needed_m;
    for (std::size_t i = 0; i < places_m.size(); ++i) {
        needed_m.push_back(ground_heights_m[i] + std::max(0.0, min_clearance_m - places_m[i].z));
    }
    return raised_over_ground(path, needed_m, limits);
}

} // namespace

sim::Trajectory with_same_placement(const sim::Trajectory& path, const PlacedPath& placed) {
    return raised(moved(path, {placed.heading_rad, placed.origin_m}), placed.offset_m);
}

void check_over_ground(const sim::Trajectory& in_world, const GroundHeight& ground) {
    const std::vector<double> times_s = step_times(in_world);
    const std::vector<glm::dvec3> places_m = places_along(in_world, times_s);
    check_clear(times_s, places_m, heights_on_map(times_s, places_m, ground));
}

PlacedPath place_over_ground(const sim::Trajectory& path, const PlacementOptions& placement, const GroundHeight& ground,
    double min_clearance_m, const std::optional<sim::AircraftLimits>& limits) {
    const std::vector<double> times_s = step_times(path, placement.from_s, placement.to_s);
    const Choice choice = chosen(places_along(path, times_s), times_s, placement, ground);
    // A turn by 0 rounds attitudes once more and drops the signs of zeros.
    const bool as_it_was =
        placement.mode == sim::HeightMode::Datum && choice.heading_rad == 0.0 && choice.origin_m == glm::dvec2(0.0);
    const sim::Trajectory over = as_it_was ? path : moved(path, choice);
    std::vector<glm::dvec3> places_m = places_along(over, times_s);
    const std::vector<double> ground_m = placement.may_leave_map ? heights_where_known(times_s, places_m, ground)
                                                                 : heights_on_map(times_s, places_m, ground);
    sim::Trajectory placed = over;
    bool follows = true;
    if (placement.mode == sim::HeightMode::Follow) {
        RaisedPath lifted = following(over, places_m, ground_m, min_clearance_m, *limits);
        follows = lifted.follows;
        placed = std::move(lifted.trajectory);
        places_m = places_along(placed, times_s);
    }
    Lowest lowest = lowest_of(places_m, ground_m);
    const double missing_m = min_clearance_m - lowest.clearance_m;
    // Between samples a curve may dip a little below the envelope that the samples lie on.
    if (placement.mode == sim::HeightMode::Clear || (placement.mode == sim::HeightMode::Follow && missing_m > 0.0)) {
        placed = raised(placed, missing_m);
        places_m = places_along(placed, times_s);
        lowest = lowest_of(places_m, ground_m);
    }
    check_clear(times_s, places_m, ground_m);
    const double offset_m = min_added_m(over, placed);
    std::vector<std::string> notes;
    if (!follows) {
        notes.push_back(fmt::format("the ground is too steep to follow within the aircraft's limits: the whole path is "
                                    "lifted by {:.1f} m",
            offset_m));
    }
    const auto beside = std::ranges::count(ground_m, no_ground_m);
    if (beside > 0) {
        notes.push_back(fmt::format("for {:.1f} s of the flight no ground is known below: it is beside the map",
            static_cast<double>(beside) * sim::step_s));
    }
    return {std::move(placed), offset_m, choice.heading_rad, choice.origin_m, lowest.clearance_m, times_s[lowest.step],
        std::move(notes)};
}

} // namespace octant::flightpaths
