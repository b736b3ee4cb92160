#include "flightpaths/placement.h"

#include "flightpaths/ground_follow.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "sim/fixed_step.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace octant::flightpaths {

namespace {

constexpr int headings = 24;
/// Reliefs closer than this count as equal, so that rounding does not choose.
constexpr double same_relief_m = 1e-6;
/// A clearance of no more than this is contact, for the same reason.
constexpr double contact_m = 1e-6;

/// The times of all steps from the start of a path on, and of its end.
std::vector<double> step_times(const sim::Trajectory& path) {
    const double duration_s = path.end_s() - path.start_s();
    const long steps = static_cast<long>(std::ceil(duration_s * sim::steps_per_second - 1e-6));
    std::vector<double> times_s;
    for (long step = 0; step <= steps; ++step) {
        times_s.push_back(path.start_s() + std::min(duration_s, sim::time_of_step(step)));
    }
    return times_s;
}

std::vector<glm::dvec3>
places_along(const sim::Trajectory& path, const std::vector<double>& times_s) {
    std::vector<glm::dvec3> places_m;
    places_m.reserve(times_s.size());
    for (const double time_s : times_s) {
        places_m.push_back(path.state_at(time_s).position_m);
    }
    return places_m;
}

glm::dquat turn_by(double heading_rad) {
    return glm::angleAxis(-heading_rad, glm::dvec3(0.0, 0.0, 1.0));
}

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
    const std::vector<double>& times_s,
    const std::vector<glm::dvec3>& places_m,
    const GroundHeight& ground) {
    GroundTrack track = ground_along(places_m, ground);
    if (track.leaves_at) {
        throw OutsideMapError(
            "path leaves the map at " +
            where(times_s[*track.leaves_at], places_m[*track.leaves_at]));
    }
    return std::move(track.heights_m);
}

std::vector<glm::dvec3>
turned(const std::vector<glm::dvec3>& places_m, double heading_rad, const glm::dvec2& origin_m) {
    const glm::dquat turn = turn_by(heading_rad);
    std::vector<glm::dvec3> out;
    out.reserve(places_m.size());
    for (const glm::dvec3& place : places_m) {
        out.push_back(turn * place + glm::dvec3(origin_m, 0.0));
    }
    return out;
}

struct Choice {
    double heading_rad = 0.0;
    glm::dvec2 origin_m{0.0};
};

/// The heading of least height difference on the ground; nothing when every heading leaves the map.
std::optional<Choice> min_relief(
    const std::vector<glm::dvec3>& places_m,
    const glm::dvec2& pivot_m,
    const glm::dvec2& place_m,
    const GroundHeight& ground) {
    std::optional<Choice> best;
    double best_relief_m = std::numeric_limits<double>::infinity();
    for (int candidate = 0; candidate < headings; ++candidate) {
        const double heading_rad = 2.0 * pi * candidate / headings;
        const glm::dvec2 origin_m =
            place_m - glm::dvec2(turn_by(heading_rad) * glm::dvec3(pivot_m, 0.0));
        const GroundTrack track = ground_along(turned(places_m, heading_rad, origin_m), ground);
        if (track.leaves_at) {
            continue;
        }
        const auto [low, high] =
            std::minmax_element(track.heights_m.begin(), track.heights_m.end());
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

Choice chosen(
    const std::vector<glm::dvec3>& places_m,
    const std::vector<double>& times_s,
    const PlacementOptions& placement,
    const GroundHeight& ground) {
    if (placement.heading_rad) {
        return {wrapped_to_two_pi(*placement.heading_rad), placement.place_m};
    }
    auto best = min_relief(places_m, glm::dvec2(0.0), placement.place_m, ground);
    if (!best) {
        best = min_relief(places_m, middle_of(places_m), placement.place_m, ground);
    }
    if (best) {
        return *best;
    }
    const auto as_is = turned(places_m, 0.0, placement.place_m);
    const std::size_t at = ground_along(as_is, ground).leaves_at.value_or(0);
    throw OutsideMapError(fmt::format(
        "path leaves the map at every heading, with heading 0 at {}",
        where(times_s[at], as_is[at])));
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
    for (sim::AircraftState& state : samples) {
        state.position_m.z += by_m;
    }
    return sim::Trajectory(std::move(samples));
}

struct Lowest {
    double clearance_m = 0.0;
    std::size_t step = 0;
};

Lowest
lowest_of(const std::vector<glm::dvec3>& places_m, const std::vector<double>& ground_heights_m) {
    Lowest lowest{places_m.front().z - ground_heights_m.front(), 0};
    for (std::size_t i = 1; i < places_m.size(); ++i) {
        const double clearance_m = places_m[i].z - ground_heights_m[i];
        if (clearance_m < lowest.clearance_m) {
            lowest = {clearance_m, i};
        }
    }
    return lowest;
}

/// Throws where a path meets the ground.
void check_clear(
    const std::vector<double>& times_s,
    const std::vector<glm::dvec3>& places_m,
    const std::vector<double>& ground_heights_m) {
    const double clearance_m = lowest_of(places_m, ground_heights_m).clearance_m;
    if (clearance_m > contact_m) {
        return;
    }
    std::size_t first = 0;
    while (first + 1 < places_m.size() && places_m[first].z - ground_heights_m[first] > contact_m) {
        ++first;
    }
    throw Error(fmt::format(
        "path meets the ground at {}, and is {:.1f} m below it at its lowest",
        where(times_s[first], places_m[first]),
        std::max(0.0, -clearance_m)));
}

double min_added_m(const sim::Trajectory& before, const sim::Trajectory& after) {
    double min_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < before.samples().size(); ++i) {
        min_m =
            std::min(min_m, after.samples()[i].position_m.z - before.samples()[i].position_m.z);
    }
    return min_m;
}

RaisedPath following(
    const sim::Trajectory& path,
    const std::vector<glm::dvec3>& places_m,
    const std::vector<double>& ground_heights_m,
    double min_clearance_m,
    const sim::AircraftLimits& limits) {
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

PlacedPath place_over_ground(
    const sim::Trajectory& path,
    const PlacementOptions& placement,
    const GroundHeight& ground,
    double min_clearance_m,
    const std::optional<sim::AircraftLimits>& limits) {
    const std::vector<double> times_s = step_times(path);
    const Choice choice = chosen(places_along(path, times_s), times_s, placement, ground);
    // A turn by 0 rounds attitudes once more and drops the signs of zeros.
    const bool as_it_was = placement.mode == sim::HeightMode::Datum && choice.heading_rad == 0.0 &&
                           choice.origin_m == glm::dvec2(0.0);
    const sim::Trajectory over = as_it_was ? path : moved(path, choice);
    std::vector<glm::dvec3> places_m = places_along(over, times_s);
    const std::vector<double> ground_m = heights_on_map(times_s, places_m, ground);
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
    if (placement.mode == sim::HeightMode::Clear ||
        (placement.mode == sim::HeightMode::Follow && missing_m > 0.0)) {
        placed = raised(placed, missing_m);
        places_m = places_along(placed, times_s);
        lowest = lowest_of(places_m, ground_m);
    }
    check_clear(times_s, places_m, ground_m);
    const double offset_m = min_added_m(over, placed);
    std::vector<std::string> notes;
    if (!follows) {
        notes.push_back(fmt::format(
            "the ground is too steep to follow within the aircraft's limits: the whole path is "
            "lifted by {:.1f} m",
            offset_m));
    }
    return {
        std::move(placed),
        offset_m,
        choice.heading_rad,
        choice.origin_m,
        lowest.clearance_m,
        times_s[lowest.step],
        std::move(notes)};
}

} // namespace octant::flightpaths
