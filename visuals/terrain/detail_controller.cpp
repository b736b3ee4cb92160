// Control of the number of triangles by the resolution C.
//
// Source: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that Minimize Flickering Effect",
// section 3, equations (4) and (5).
// Deviations:
// - As printed, dn of equation (4) is the change of N from frame to frame, which holds no target
//   and with the sign printed runs away; that reading is kept as Literal, with the sign that
//   repeats figure 6. Previous and Damped take dn = target - N.
// - Equation (5) averages the results of (4), each counted from the C actually used. Averages of
//   undamped results or of used values hardly damp.
// - Weights are r+1, ..., 2, 1 over their sum, newest first: the paper only demands that they fall.
// - Limits of C and automatic a are additions, and the dead band of Damped with what belongs to it:
//   (5) averages r + 1 frames. Once that many and more were made of one standing view, they are
//   points of one curve N(C), and C is read off between the two that enclose the target instead:
//   a slow or ringing loop ends there. N(C) is a staircase. Where the two points are so close that
//   only a step can lie between them, that step is the dead band, and the nearer one is held.
#include "visuals/terrain/detail_controller.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace octant::visuals::terrain {

namespace {

/// a of equation (4). Far from the target the automatic one limits a step to a factor 1 + g / p
/// upward and 1 - g / p downward.
double
triangles_per_resolution(const ControlSettings& settings, double resolution, double triangles) {
    if (settings.triangles_per_resolution > 0.0) {
        return settings.triangles_per_resolution;
    }
    return settings.growth_exponent * std::max(triangles, settings.target_triangles) /
           (settings.loop_gain * resolution);
}

/// C stays for now and the past is forgotten.
DetailState held(const DetailState& state, double triangles) {
    DetailState next = state;
    next.last_triangles = triangles;
    next.earlier.fill(state.resolution);
    return next;
}

/// N(C) between two points that are closer than this factor in C is one step: a smooth curve, N ~
/// C^2 at most, would rise by less than half the usual dead band.
constexpr double step_width = 1.001;
constexpr double most_change = 2.0; ///< of C in a frame, where only one side is known

/// `state` with the last mesh among the points of its view.
DetailState measured(DetailState state, double target, double triangles, bool same_view) {
    if (!same_view) {
        state.standing_frames = 0;
        state.below = {};
        state.above = {};
    }
    ++state.standing_frames;
    CountAt& nearest = triangles < target ? state.below : state.above;
    const bool nearer = triangles < target ? state.resolution > nearest.resolution
                                           : state.resolution < nearest.resolution;
    if (nearest.resolution <= 0.0 || nearer) {
        nearest = {state.resolution, triangles};
    }
    return state;
}

bool is_enclosed(const DetailState& state) {
    return state.below.resolution > 0.0 && state.above.resolution > state.below.resolution;
}

/// Whether the target lies within a step of N(C) of which the last mesh is the nearer end.
bool is_on_nearest_step(const DetailState& state, double target, double triangles) {
    return is_enclosed(state) && state.above.resolution < step_width * state.below.resolution &&
           std::abs(target - triangles) <=
               std::min(target - state.below.triangles, state.above.triangles - target);
}

/// C at which the points of the view promise the target: on the line between their logarithms, in
/// every third frame the middle, so that the points always close in.
double read_off(const DetailState& state, double target, double triangles) {
    if (!is_enclosed(state)) {
        const double ratio = target / std::max(triangles, 1.0);
        return state.resolution * std::clamp(ratio, 1.0 / most_change, most_change);
    }
    const CountAt& below = state.below;
    const CountAt& above = state.above;
    if (above.resolution < step_width * below.resolution) {
        return target - below.triangles < above.triangles - target ? below.resolution
                                                                   : above.resolution;
    }
    const double rise = std::log(above.triangles / std::max(below.triangles, 1.0));
    const double share = state.standing_frames % 3 == 0 || rise <= 0.0
                             ? 0.5
                             : std::log(target / std::max(below.triangles, 1.0)) / rise;
    return below.resolution *
           std::pow(above.resolution / below.resolution, std::clamp(share, 0.02, 0.98));
}

/// Equation (5).
double weighted_mean(double newest, const DetailState& state, int remembered_frames) {
    double weight = remembered_frames + 1.0;
    double sum = newest * weight;
    double weights = weight;
    for (int k = 0; k < remembered_frames; ++k) {
        weight -= 1.0;
        sum += weight * state.earlier[static_cast<std::size_t>(k)];
        weights += weight;
    }
    return sum / weights;
}

} // namespace

DetailState starting_at(double resolution, const ControlSettings& settings) {
    DetailState state;
    state.resolution = std::clamp(resolution, settings.min_resolution, settings.max_resolution);
    return held(state, 0.0);
}

DetailState next_state(
    const DetailState& state, const ControlSettings& settings, double triangles, bool same_view) {
    const double target = settings.target_triangles;
    assert(target > 0.0 && triangles >= 0.0);
    assert(settings.loop_gain > 0.0 && settings.growth_exponent > 0.0);
    assert(settings.remembered_frames >= 0 && settings.remembered_frames <= max_remembered_frames);
    const double missing = target - triangles;
    DetailState next = measured(state, target, triangles, same_view);
    const bool settles = settings.method == ControlMethod::Damped && settings.dead_band > 0.0;
    if (settles && (std::abs(missing) <= settings.dead_band * target ||
                    is_on_nearest_step(next, target, triangles))) {
        return held(next, triangles);
    }
    const auto limited = [&](double resolution) {
        return std::clamp(resolution, settings.min_resolution, settings.max_resolution);
    };
    if (settles && next.standing_frames > settings.remembered_frames) {
        next.resolution = limited(read_off(next, target, triangles));
        return held(next, triangles);
    }
    const double change =
        settings.method == ControlMethod::Literal ? state.last_triangles - triangles : missing;
    const double candidate = limited(
        state.resolution +
        change / triangles_per_resolution(settings, state.resolution, triangles));
    next.last_triangles = triangles;
    next.resolution = settings.method == ControlMethod::Damped
                          ? weighted_mean(candidate, state, settings.remembered_frames)
                          : candidate;
    std::shift_right(next.earlier.begin(), next.earlier.end(), 1);
    next.earlier[0] = candidate;
    return next;
}

} // namespace octant::visuals::terrain
