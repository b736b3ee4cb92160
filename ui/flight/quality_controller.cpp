#include "ui/flight/quality_controller.h"

#include <cassert>
#include <cstddef>
#include <limits>

namespace octant::ui::flight {

namespace scene = visuals::scene;
namespace shading = visuals::shading;

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
        const int replayed = replayed_targets_[number].smooth_target;
        return replayed < 0 ? std::nullopt : std::optional(replayed);
    }
    if (!adapt_.shading) {
        return std::nullopt;
    }
    return shading_ ? shading_->smooth : 0;
}

double QualityController::add_frame(const FrameMeasurement& outcome) {
    add_shading_frame(outcome);
    if (!adapt_.terrain) {
        return outcome.frame_ms * rate_hz_ / 1000.0;
    }
    if (!outcome.warm_up) {
        stress_ =
            next_state(stress_, stress_settings_, {outcome.frame_ms, outcome.terrain_triangles});
    }
    return stress_.stress.value_or(std::numeric_limits<double>::quiet_NaN());
}

void QualityController::add_shading_frame(const FrameMeasurement& outcome) {
    if (!adapt_.shading || outcome.warm_up || outcome.smoothable_polygons == 0) {
        return;
    }
    if (!shading_) {
        shading_ = shading::initial_shading_state(outcome.smoothable_polygons);
        return;
    }
    shading::ShadingControllerSettings control;
    control.target_frame_ms = 1000.0 / rate_hz_;
    shading_ = shading::update_shading(
        *shading_,
        control,
        {outcome.frame_ms,
         outcome.smoothable_polygons - outcome.smooth_polygons,
         outcome.smooth_polygons},
        outcome.smoothable_polygons);
}

} // namespace octant::ui::flight
