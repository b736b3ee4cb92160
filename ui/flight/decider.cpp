#include "ui/flight/decider.h"

#include <cassert>
#include <cstddef>
#include <limits>

namespace octant::ui::flight {

namespace scene = visuals::scene;
namespace shading = visuals::shading;

void Decider::begin(const scene::Settings& settings, double rate_hz) {
    adapt_ = settings.adapt;
    rate_hz_ = rate_hz;
    settled_triangles_ = scene::triangle_target(settings);
    stress_settings_ = stress_settings(settings, rate_hz);
    stress_ = starting_at(settled_triangles_, stress_settings_);
    shading_.reset();
}

int Decider::triangle_target(int frame) {
    if (!replayed_.empty()) {
        const auto number = static_cast<std::size_t>(frame);
        assert(number < replayed_.size());
        stress_ = with_target(stress_, replayed_[number].triangle_target);
        return stress_.triangles();
    }
    return adapt_.terrain ? stress_.triangles() : settled_triangles_;
}

std::optional<int> Decider::smooth_target(int frame) const {
    if (!replayed_.empty()) {
        const auto number = static_cast<std::size_t>(frame);
        assert(number < replayed_.size());
        const int replayed = replayed_[number].smooth_target;
        return replayed < 0 ? std::nullopt : std::optional(replayed);
    }
    if (!adapt_.shading) {
        return std::nullopt;
    }
    return shading_ ? shading_->smooth : 0;
}

double Decider::learn(const FrameOutcome& outcome) {
    learn_shading(outcome);
    if (!adapt_.terrain) {
        return outcome.frame_ms * rate_hz_ / 1000.0;
    }
    if (!outcome.warm_up) {
        stress_ =
            next_state(stress_, stress_settings_, {outcome.frame_ms, outcome.terrain_triangles});
    }
    return stress_.stress.value_or(std::numeric_limits<double>::quiet_NaN());
}

void Decider::learn_shading(const FrameOutcome& outcome) {
    if (!adapt_.shading || outcome.warm_up || outcome.may_be_smooth == 0) {
        return;
    }
    if (!shading_) {
        shading_ = shading::starting_shading(outcome.may_be_smooth);
        return;
    }
    shading::ShadingControl control;
    control.share_ms = 1000.0 / rate_hz_;
    shading_ = shading::next_shading(
        *shading_,
        control,
        {outcome.frame_ms,
         outcome.may_be_smooth - outcome.smooth_polygons,
         outcome.smooth_polygons},
        outcome.may_be_smooth);
}

} // namespace octant::ui::flight
