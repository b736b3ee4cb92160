// Chooses the number of smooth polygons from measured frame times. H. Kim, H. Park, "A Hybrid Rendering Model to
// support LOD (Level of Detail)", 2008, leave this for later (section 5: "an algorithm that finds the numbers of flat
// and Gouraud polygons by itself").
//
// The model is t = a + bf f + bg g, where f polygons are flat, g are smooth and n = f + g. The wanted number follows
// from it: g = clamp((T - a - bf n) / (bg - bf), 0, n).
//
// - Recursive least squares fit the equal form t = a + bf n + (bg - bf) g. Old frames are forgotten
//   by letting the variance of each coefficient grow: fast for a, for the rest of the frame
//   changes; slowly for bf and bg - bf, for the machine does not. One common forgetting factor
//   would mistake drift of a for knowledge about bg - bf. Where n never changes, a and bf n are
//   known only as a sum, and the formula needs nothing else.
// - A fit that has seen a single g cannot tell smooth polygons from flat ones. The way from all
//   flat to the first target shows many values of g. Later, while the standard deviation of bg - bf
//   is more than a fifth of it, a probe is made: 1 % of the polygons, those that are smooth by the
//   narrowest margin, turn flat during half of each cycle of probe_frames.
// - A single slow frame is not learnt from. Three in a row mean that the load changed, and a is
//   learnt anew.
// - The target moves at once when frames come too near to T, and otherwise only across a dead band.
// - When bg - bf is below two of its standard deviations, flat polygons gain nothing that can be
//   measured, and all polygons are smooth. On the way there g changes in the largest steps, so that
//   a gain would show. What could still be a fifth of T is not called nothing.
#include "visuals/shading/shading_controller.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace octant::visuals::shading {

namespace {

using Vector = std::array<double, 3>;

constexpr std::size_t level = 0;
constexpr std::size_t slope = 2;
/// The variance of a coefficient of which nothing is known, in the noise's variance.
constexpr double unknown = 1e4;
/// The dead band never gets wider than this share of the polygons.
constexpr double widest_band = 0.2;
/// A fit from fewer frames than this may not judge whether flat polygons gain anything.
constexpr int learning_frames = 30;
constexpr int surprises_of_change = 3; ///< So many surprises in a row mean that the load changed.

double dot(const Vector& one, const Vector& other) { return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]; }

Vector times(const std::array<double, 9>& matrix, const Vector& vector) {
    Vector product{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) { product[i] += matrix[3 * i + k] * vector[k]; }
    }
    return product;
}

/// The factors on a, bf n0 and (bg - bf) n0 in the model of the frame time.
Vector regressors(const FrameTimeModel& fit, double polygons, double smooth) {
    return {1.0, polygons / fit.polygons, smooth / fit.polygons};
}

/// Lets every coefficient's variance grow by its drift, up to that of an unknown one, so that old frames count less.
void discount(FrameTimeModel& fit, const ShadingControllerSettings& control) {
    const Vector drift{control.level_drift, control.slope_drift, control.slope_drift};
    for (std::size_t i = 0; i < 3; ++i) {
        double& variance = fit.covariance[4 * i];
        variance = std::max(variance, std::min(variance + drift[i], unknown));
    }
}

/// After a change of load: a may now be anything, and bg - bf may differ by a third.
void open_up(FrameTimeModel& fit) {
    fit.covariance[4 * level] += unknown;
    const double third = fit.ms[slope] / 3.0 / fit.noise_ms;
    fit.covariance[4 * slope] += std::min(third * third, unknown);
    fit.frames = 0;
    fit.surprises = 0;
}

/// One step of recursive least squares. `x` are the regressors of a frame that took `missed_ms` longer than the fit
/// expected.
void correct(FrameTimeModel& fit, const Vector& x, double missed_ms) {
    const Vector spread = times(fit.covariance, x);
    const double total = 1.0 + dot(x, spread);
    for (std::size_t i = 0; i < 3; ++i) {
        fit.ms[i] += spread[i] / total * missed_ms;
        for (std::size_t k = 0; k < 3; ++k) { fit.covariance[3 * i + k] -= spread[i] * spread[k] / total; }
    }
}

/// The fit after one more frame: forgets, judges whether the frame is a surprise, an outlier or a change of load,
/// corrects the coefficients and updates the estimate of the noise.
FrameTimeModel updated_fit(FrameTimeModel fit, const ShadingControllerSettings& control, const MeasuredFrame& frame) {
    const Vector x = regressors(fit, frame.flat + frame.smooth, frame.smooth);
    const bool first = fit.noise_ms == 0.0;
    if (first) { fit.noise_ms = std::max(0.02 * frame.frame_ms, 1e-3); }
    discount(fit, control);
    const double missed_ms = frame.frame_ms - dot(fit.ms, x);
    const double deviation = std::sqrt(1.0 + dot(x, times(fit.covariance, x)));
    const double surprise = missed_ms / deviation / fit.noise_ms;
    if (std::abs(surprise) > control.surprise_sds && !first) {
        const int side = surprise > 0.0 ? 1 : -1;
        fit.surprises = fit.surprises * side > 0 ? fit.surprises + side : side;
    } else {
        fit.surprises = 0;
    }
    const bool changed = std::abs(fit.surprises) >= surprises_of_change;
    if (changed) { open_up(fit); }
    if (changed || first || std::abs(surprise) <= control.outlier_sds) { correct(fit, x, missed_ms); }
    if (!first && !changed) {
        const double counted = std::min(std::abs(surprise), control.surprise_sds);
        const double weight = std::max(control.noise_weight, 1.0 / (fit.frames + 5.0));
        fit.noise_ms *= std::sqrt(1.0 + weight * (counted * counted - 1.0));
        fit.noise_ms = std::max(fit.noise_ms, 1e-3);
    }
    ++fit.frames;
    return fit;
}

/// The standard deviation of (bg - bf) n0.
double slope_sd_ms(const FrameTimeModel& fit) {
    return fit.noise_ms * std::sqrt(std::max(fit.covariance[4 * slope], 0.0));
}

/// Whether flat polygons gain nothing or too little to be measured. `before` is the last judgement: it takes clearer
/// evidence to change it than to keep it.
bool full_detail(bool before, const FrameTimeModel& fit, const ShadingControllerSettings& control) {
    const double sd_ms = slope_sd_ms(fit);
    const bool is_little = fit.ms[slope] + 2.0 * sd_ms < control.min_gain_ratio * control.target_frame_ms;
    if (before) { return fit.ms[slope] < 4.0 * sd_ms && (is_little || fit.frames < learning_frames); }
    return fit.frames >= learning_frames && is_little && fit.ms[slope] < 2.0 * sd_ms;
}

/// Moves `target` towards the best number of smooth polygons, by at most one largest step.
void compute_target(ShadingState& state, const ShadingControllerSettings& control) {
    const FrameTimeModel& fit = state.fit;
    const double n = state.polygons;
    const double per_polygon_ms = std::max(fit.ms[slope], 1e-3 * control.target_frame_ms) / fit.polygons;
    const Vector now = regressors(fit, n, state.target);
    const double expected_ms = dot(fit.ms, now);
    const double room_ms = control.target_frame_ms - expected_ms;
    const double more = (room_ms - control.target_margin_sds * fit.noise_ms) / per_polygon_ms;
    const double best = state.has_no_gain ? n : std::clamp(state.target + more, 0.0, n);
    const double unsure = fit.noise_ms * std::sqrt(std::max(dot(now, times(fit.covariance, now)), 0.0));
    const double band =
        n * std::clamp(std::max(4.0 * unsure, fit.noise_ms) / per_polygon_ms / n, control.dead_band, widest_band);
    const bool too_many = best < state.target && room_ms < control.overload_sds * fit.noise_ms;
    const bool too_few = best > state.target + band || (best == n && state.has_no_gain);
    const double off = std::abs(best - state.target);
    state.moving = off > 0.0 && (too_many || too_few || (state.moving && off > 0.01 * n));
    if (state.moving) {
        const double step = std::max(control.max_step * n, 1.0);
        state.target += std::clamp(best - state.target, -step, step);
    }
}

/// g of the next frame: the target, or a little less of it while the cost of smooth polygons is not known well enough.
int probed(ShadingState& state, const ShadingControllerSettings& control) {
    const bool is_known = slope_sd_ms(state.fit) < 0.2 * state.fit.ms[slope];
    // Rounded down, for one polygon more would not fit into T.
    const int target = static_cast<int>(state.target + 1e-6);
    if (is_known || state.moving || state.has_no_gain || target == state.polygons) {
        state.probe_frame = 0;
        return target;
    }
    state.probe_frame = (state.probe_frame + 1) % control.probe_frames;
    if (2 * state.probe_frame < control.probe_frames) { return target; }
    // Where not even all flat fits, the machine is asked in one large step what smooth ones cost.
    const double share = target == 0 ? control.max_step : control.probe;
    const int probe = std::max(static_cast<int>(share * state.polygons), 1);
    if (target != 0 && probe > control.max_probe * state.polygons) {
        return target; // few polygons: one of them is too much
    }
    return target >= probe ? target - probe : target + probe;
}

} // namespace

ShadingState initial_shading_state(int polygons) {
    assert(polygons >= 1);
    ShadingState state;
    state.polygons = polygons;
    state.fit.polygons = polygons;
    for (std::size_t i = 0; i < 3; ++i) { state.fit.covariance[4 * i] = unknown; }
    return state;
}

ShadingState update_shading(
    const ShadingState& state, const ShadingControllerSettings& control, const MeasuredFrame& frame, int polygons) {
    assert(control.target_frame_ms > 0.0 && control.probe_frames >= 2 && polygons >= 1);
    assert(control.level_drift >= 0.0 && control.slope_drift >= 0.0);
    assert(control.overload_sds >= 0.0 && control.overload_sds <= control.target_margin_sds);
    assert(frame.frame_ms >= 0.0 && frame.flat >= 0 && frame.smooth >= 0);
    ShadingState next = state;
    next.fit = updated_fit(state.fit, control, frame);
    next.polygons = polygons;
    next.target = std::min<double>(state.target, polygons);
    next.has_no_gain = full_detail(state.has_no_gain, next.fit, control);
    compute_target(next, control);
    next.smooth = probed(next, control);
    return next;
}

} // namespace octant::visuals::shading
