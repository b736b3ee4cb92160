// Holds the number of triangles N near a target by the resolution C: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD
// Method that Minimize Flickering Effect", section 3. Equation (4) is C_next = C + dn / a; equation (5) damps it by a
// weighted mean of its last r + 1 results.
//
// Deviations:
// - As printed, dn of equation (4) is the change of N from frame to frame. That holds no target,
//   and with the printed sign it runs away; this reading is kept as Literal, with the sign that
//   repeats figure 6. Previous and Damped take dn = target - N.
// - Equation (5) averages the results of (4), each of which starts from the C actually used.
//   Averages of undamped results, or of the values used, hardly damp.
// - The weights are r+1, ..., 2, 1 over their sum, newest first; the paper only demands that they
//   fall.
// - Limits of C and an automatic a are additions.
// - So is the dead band of Damped, with the following. Equation (5) averages r + 1 frames. Once
//   more than r frames were made of one standing view, they are points of one curve N(C), and C is
//   read off between the two points that enclose the target; that ends a slow or ringing loop. N(C)
//   is a staircase: where nearly all of the difference between the two points is a single step,
//   that step is the dead band, and its nearer end is held.
// - Tuned has no source. It looks at the view before it is satisfied: while N misses the target it
//   meshes the same view again, with the a of equation (4) for which g = 1. The meshes of one view
//   are points of one curve N(C), so that their difference tells N'(C), and two on both sides of
//   the target enclose it.
#include "visuals/terrain/quadtree_control.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace octant::visuals::terrain {

namespace {

/// a of equation (4). Far from the target the automatic one limits a step to a factor of 1 + g / p upwards and of 1 - g
/// / p downwards.
double triangles_per_resolution(const ControlSettings& settings, double resolution, double triangles) {
    if (settings.triangles_per_resolution > 0.0) { return settings.triangles_per_resolution; }
    return settings.growth_exponent * std::max(triangles, settings.target_triangles) /
           (settings.loop_gain * resolution);
}

/// The state in which C stays as it is and the past is forgotten.
ControlState held(const ControlState& state, double triangles) {
    ControlState next = state;
    next.last_triangles = triangles;
    next.earlier_results.fill(state.resolution);
    return next;
}

/// Two points of N(C) closer than this factor in C always count as the two ends of one step.
constexpr double step_width = 1.001;
/// So do two points between which N rises this many times as fast as N ~ C^2, the most that a smooth curve does.
constexpr double step_steepness = 4.0;
/// C changes at most by this factor in a frame while points lie on one side of the target only.
constexpr double max_change = 2.0;
constexpr double smallest_exponent = 0.25; ///< The least exponent p that is believed then.

/// `state` with the last mesh added to the points of its view.
ControlState measured(ControlState state, double target, double triangles, bool same_view) {
    if (!same_view) {
        state.still_frames = 0;
        state.below = {};
        state.above = {};
    }
    ++state.still_frames;
    CountSample& nearest = triangles < target ? state.below : state.above;
    const bool nearer =
        triangles < target ? state.resolution > nearest.resolution : state.resolution < nearest.resolution;
    if (nearest.resolution <= 0.0 || nearer) { nearest = {state.resolution, triangles}; }
    return state;
}

/// Whether there are points on both sides of the target.
bool is_enclosed(const ControlState& state) {
    return state.below.resolution > 0.0 && state.above.resolution > state.below.resolution;
}

/// Whether the two points around the target are the ends of one step of N(C), or closer in C than `narrowest`, a
/// factor.
bool is_at_step(const ControlState& state, double narrowest) {
    if (!is_enclosed(state)) { return false; }
    const double width = std::log(state.above.resolution / state.below.resolution);
    const double smooth = 2.0 * width * state.above.triangles;
    return width < std::log(narrowest) || state.above.triangles - state.below.triangles > step_steepness * smooth;
}

/// The one of the two points whose N is nearer to the target.
const CountSample& nearer_end(const ControlState& state, double target) {
    return target - state.below.triangles < state.above.triangles - target ? state.below : state.above;
}

/// Extrapolates C to the target from the only side that is known: along N ~ C^p, with p from the two points nearest
/// last, but at most 1, so that the other side is soon met.
double read_beyond(const CountSample& before, const CountSample& nearest, double target) {
    double exponent = 1.0;
    if (before.resolution > 0.0 && before.resolution != nearest.resolution) {
        exponent = std::log(std::max(nearest.triangles, 1.0) / std::max(before.triangles, 1.0)) /
                   std::log(nearest.resolution / before.resolution);
    }
    const double ratio =
        std::pow(target / std::max(nearest.triangles, 1.0), 1.0 / std::clamp(exponent, smallest_exponent, 1.0));
    return nearest.resolution * std::clamp(ratio, 1.0 / max_change, max_change);
}

/// p of N ~ C^p with what another mesh of the same view tells about it.
double tuned_exponent(const ControlState& state, double triangles) {
    constexpr double min_change = 1e-4; // of C; less tells of single steps only
    constexpr double trust = 0.3;
    const double change = std::log(state.resolution / state.last.resolution);
    if (std::abs(change) < min_change || triangles < 1.0 || state.last.triangles < 1.0) { return state.exponent; }
    const double seen = std::log(triangles / state.last.triangles) / change;
    return state.exponent + trust * (std::clamp(seen, smallest_exponent, 4.0) - state.exponent);
}

/// The C of the mesh after this one, which Tuned wants nearer to the target: the nearer end of a step, else on the line
/// through the two points around the target (at times in their middle), else by equation (4) with g = 1.
double tuned_resolution(const ControlState& state, double target, double triangles) {
    constexpr double narrowest = 1.00001;
    if (is_at_step(state, narrowest)) { return nearer_end(state, target).resolution; }
    if (!is_enclosed(state)) {
        const double ratio = std::pow(target / std::max(triangles, 1.0), 1.0 / state.exponent);
        return state.resolution * std::clamp(ratio, 1.0 / max_change, max_change);
    }
    const double rise = std::log(state.above.triangles / std::max(state.below.triangles, 1.0));
    const double share = state.still_frames % max_tuned_meshes == 0 || rise <= 0.0
                             ? 0.5
                             : std::log(target / std::max(state.below.triangles, 1.0)) / rise;
    return state.below.resolution *
           std::pow(state.above.resolution / state.below.resolution, std::clamp(share, 0.02, 0.98));
}

/// The C at which the points of the view promise the target: between two points on the line through their logarithms,
/// and in every other frame in the middle, so that they always close in. `before` is the state without the last point.
double read_off(const ControlState& before, const ControlState& state, double target) {
    const CountSample& below = state.below;
    const CountSample& above = state.above;
    if (is_at_step(state, step_width)) { return nearer_end(state, target).resolution; }
    if (!is_enclosed(state)) {
        return above.resolution > 0.0 ? read_beyond(before.above, above, target)
                                      : read_beyond(before.below, below, target);
    }
    const double rise = std::log(above.triangles / std::max(below.triangles, 1.0));
    const double share =
        state.still_frames % 2 == 0 || rise <= 0.0 ? 0.5 : std::log(target / std::max(below.triangles, 1.0)) / rise;
    return below.resolution * std::pow(above.resolution / below.resolution, std::clamp(share, 0.02, 0.98));
}

/// Equation (5): the mean of `newest` and the earlier results, weighted r+1, ..., 2, 1.
double weighted_mean(double newest, const ControlState& state, int averaged_frames) {
    double weight = averaged_frames + 1.0;
    double sum = newest * weight;
    double weights = weight;
    for (int k = 0; k < averaged_frames; ++k) {
        weight -= 1.0;
        sum += weight * state.earlier_results[static_cast<std::size_t>(k)];
        weights += weight;
    }
    return sum / weights;
}

} // namespace

ControlState initial_state(double resolution, const ControlSettings& settings) {
    ControlState state;
    state.resolution = std::clamp(resolution, settings.min_resolution, settings.max_resolution);
    return held(state, 0.0);
}

ControlState next_state(const ControlState& state, const ControlSettings& settings, double triangles, bool same_view) {
    const double target = settings.target_triangles;
    assert(target > 0.0 && triangles >= 0.0);
    assert(settings.loop_gain > 0.0 && settings.growth_exponent > 0.0);
    assert(settings.averaged_frames >= 0 && settings.averaged_frames <= max_averaged_frames);
    const double missing = target - triangles;
    ControlState next = measured(state, target, triangles, same_view);
    next.last = {state.resolution, triangles};
    const bool settles = settings.method == ControlMethod::Damped && settings.dead_band > 0.0;
    if (settles && std::abs(missing) <= settings.dead_band * target) { return held(next, triangles); }
    const auto limited = [&](double resolution) {
        return std::clamp(resolution, settings.min_resolution, settings.max_resolution);
    };
    if (settings.method == ControlMethod::Tuned) {
        next.exponent = same_view ? tuned_exponent(state, triangles) : state.exponent;
        if (std::abs(missing) > settings.tuned_band * target) {
            next.resolution = limited(tuned_resolution(next, target, triangles));
        }
        return held(next, triangles);
    }
    if (settles && same_view && next.still_frames > settings.averaged_frames) {
        next.resolution = limited(read_off(state, next, target));
        return held(next, triangles);
    }
    const double change = settings.method == ControlMethod::Printed ? state.last_triangles - triangles : missing;
    const double candidate =
        limited(state.resolution + change / triangles_per_resolution(settings, state.resolution, triangles));
    next.last_triangles = triangles;
    next.resolution = settings.method == ControlMethod::Damped
                          ? weighted_mean(candidate, state, settings.averaged_frames)
                          : candidate;
    std::shift_right(next.earlier_results.begin(), next.earlier_results.end(), 1);
    next.earlier_results[0] = candidate;
    return next;
}

bool needs_another_mesh(const ControlState& state, const ControlSettings& settings, int meshes) {
    return settings.method == ControlMethod::Tuned && meshes < max_tuned_meshes &&
           state.resolution != state.last.resolution;
}

} // namespace octant::visuals::terrain
