#include "ui/flight/quality_controller.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace octant::ui::flight {

namespace scene = visuals::scene;
namespace shading = visuals::shading;
using Trend = StressState::Trend;

// Load management: the ground's triangle budget follows the frame time.
//
// Source: the load management of image generators (overload control by smoothed frame time with a dead band); no paper
// is followed.
//
// - The stress is smoothed by a first-order filter. Outside the dead band the budget glides to
//   where the smoothed stress is in the band's middle, twice as fast as the filter but in small
//   steps that geomorphs hide, and stays there: band and course together are the hysteresis.
// - A new budget takes the filter's memory with it as if the whole frame were ground: without that
//   the budget would overshoot by what it changes within the filter's time constant. What else a
//   frame holds makes a course slower, or end early and be followed by another, never swing back.

namespace {

double middle_of_band(const StressSettings& settings) { return 0.5 * (settings.min_stress + settings.max_stress); }

double time_constant_frames(const StressSettings& settings) {
    return std::max(1000.0 * settings.filter_s / settings.target_frame_ms, settings.filter_frames);
}

double filtered(double before, const StressSettings& settings, double stress) {
    return before + (1.0 - std::exp(-1.0 / time_constant_frames(settings))) * (stress - before);
}

Trend next_trend(Trend trend, const StressSettings& settings, double stress, bool budget_used) {
    const double above_middle = stress - middle_of_band(settings);
    const bool goes_on = std::abs(above_middle) > settings.settled_stress;
    if (stress > settings.max_stress || (trend == Trend::Falling && goes_on && above_middle > 0.0)) {
        return Trend::Falling;
    }
    const bool has_room = stress < settings.min_stress || (trend == Trend::Rising && goes_on && above_middle < 0.0);
    return has_room && budget_used ? Trend::Rising : Trend::Held;
}

/// What the target is multiplied with.
double change_of_target(const StressSettings& settings, double stress) {
    const double share_of_way = 1.0 - std::exp(-2.0 / time_constant_frames(settings));
    return std::clamp(1.0 + share_of_way * (middle_of_band(settings) / stress - 1.0), 1.0 - settings.max_fall,
        1.0 + settings.max_rise);
}

} // namespace

int StressState::triangles() const { return static_cast<int>(std::lround(target)); }

StressSettings stress_settings(const visuals::scene::Settings& settings, double rate_hz) {
    const int budget = visuals::scene::triangle_target(settings);
    StressSettings settings_of_run;
    settings_of_run.target_frame_ms = 1000.0 / rate_hz;
    settings_of_run.min_triangles = std::max(budget / 8, 1);
    constexpr int most = std::numeric_limits<int>::max();
    settings_of_run.max_triangles = budget > most / 4 ? most : 4 * budget;
    return settings_of_run;
}

StressState initial_state(double triangles, const StressSettings& settings) {
    StressState state;
    state.target = std::clamp<double>(triangles, settings.min_triangles, settings.max_triangles);
    state.expected_stress = middle_of_band(settings);
    return state;
}

StressState with_target(const StressState& state, int triangles) {
    StressState other = state;
    other.target = triangles;
    other.expected_stress = state.expected_stress * other.target / state.target;
    return other;
}

StressState next_state(const StressState& state, const StressSettings& settings, const FrameCost& cost) {
    assert(settings.target_frame_ms > 0.0 && settings.min_triangles >= 1 &&
           settings.max_triangles >= settings.min_triangles);
    assert(settings.min_stress > 0.0 && settings.max_stress >= settings.min_stress);
    assert(settings.max_counted_stress > settings.max_stress && settings.filter_frames >= 1.0);
    assert(cost.frame_ms >= 0.0);
    const double share_used = cost.frame_ms / settings.target_frame_ms;
    const double stress = filtered(state.expected_stress, settings, std::min(share_used, settings.max_counted_stress));
    const bool used = cost.triangles >= settings.used_share * state.target;
    StressState next;
    next.stress = filtered(state.stress.value_or(share_used), settings, share_used);
    next.trend = next_trend(state.trend, settings, stress, used);
    const double factor = next.trend == Trend::Held ? 1.0 : change_of_target(settings, stress);
    next.target = std::clamp<double>(state.target * factor, settings.min_triangles, settings.max_triangles);
    next.expected_stress = stress * next.target / state.target;
    return next;
}

void QualityController::begin(const scene::Settings& settings, double rate_hz) {
    adapt_ = settings.adapt;
    rate_hz_ = rate_hz;
    configured_triangles_ = scene::triangle_target(settings);
    stress_settings_ = stress_settings(settings, rate_hz);
    stress_ = initial_state(configured_triangles_, stress_settings_);
    shading_.reset();
}

int QualityController::triangle_target(int frame) {
    if (!replayed_targets_.empty()) {
        const auto number = static_cast<std::size_t>(frame);
        assert(number < replayed_targets_.size());
        stress_ = with_target(stress_, replayed_targets_[number].triangle_target);
        return stress_.triangles();
    }
    return adapt_.terrain ? stress_.triangles() : configured_triangles_;
}

std::optional<int> QualityController::smooth_target(int frame) const {
    if (!replayed_targets_.empty()) {
        const auto number = static_cast<std::size_t>(frame);
        assert(number < replayed_targets_.size());
        return replayed_targets_[number].smooth_target;
    }
    if (!adapt_.shading) { return std::nullopt; }
    return shading_ ? shading_->smooth : 0;
}

double QualityController::add_frame(const FrameMeasurement& measurement) {
    add_shading_frame(measurement);
    if (!adapt_.terrain) { return measurement.frame_ms * rate_hz_ / 1000.0; }
    if (!measurement.warm_up) {
        stress_ = next_state(stress_, stress_settings_, {measurement.frame_ms, measurement.terrain_triangles});
    }
    return stress_.stress.value_or(std::numeric_limits<double>::quiet_NaN());
}

void QualityController::add_shading_frame(const FrameMeasurement& measurement) {
    if (!adapt_.shading || measurement.warm_up || measurement.smoothable_polygons == 0) { return; }
    if (!shading_) {
        shading_ = shading::initial_shading_state(measurement.smoothable_polygons);
        return;
    }
    shading::ShadingControllerSettings control;
    control.target_frame_ms = 1000.0 / rate_hz_;
    shading_ = shading::update_shading(*shading_, control,
        {measurement.frame_ms, measurement.smoothable_polygons - measurement.smooth_polygons,
            measurement.smooth_polygons},
        measurement.smoothable_polygons);
}

} // namespace octant::ui::flight
