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
// - Dead band, limits of C and automatic a are additions.
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

DetailState held(const DetailState& state, double triangles) {
    DetailState next = state;
    next.last_triangles = triangles;
    next.earlier.fill(state.resolution);
    return next;
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

DetailState
next_state(const DetailState& state, const ControlSettings& settings, double triangles) {
    assert(settings.target_triangles > 0.0 && triangles >= 0.0);
    assert(settings.loop_gain > 0.0 && settings.growth_exponent > 0.0);
    assert(settings.remembered_frames >= 0 && settings.remembered_frames <= max_remembered_frames);
    const double missing = settings.target_triangles - triangles;
    const bool holds_target = settings.method != ControlMethod::Literal;
    if (holds_target && std::abs(missing) <= settings.dead_band * settings.target_triangles) {
        return held(state, triangles);
    }
    const double change = holds_target ? missing : state.last_triangles - triangles;
    const double candidate = std::clamp(
        state.resolution + change / triangles_per_resolution(settings, state.resolution, triangles),
        settings.min_resolution,
        settings.max_resolution);
    DetailState next = state;
    next.last_triangles = triangles;
    next.resolution = settings.method == ControlMethod::Damped
                          ? weighted_mean(candidate, state, settings.remembered_frames)
                          : candidate;
    std::shift_right(next.earlier.begin(), next.earlier.end(), 1);
    next.earlier[0] = candidate;
    return next;
}

} // namespace octant::visuals::terrain
