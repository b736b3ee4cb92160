#include "ui/window/real_time_factor.h"

#include <algorithm>

namespace octant::ui::window {

namespace {

constexpr double looked_at_s = 2.0;

} // namespace

void RealTimeFactor::add(double passed_s, double flown_s) {
    turns_.push_back({passed_s, flown_s});
    passed_s_ += passed_s;
    flown_s_ += flown_s;
    while (turns_.size() > 1 && passed_s_ - turns_.front().passed_s >= looked_at_s) {
        passed_s_ -= turns_.front().passed_s;
        flown_s_ -= turns_.front().flown_s;
        turns_.pop_front();
    }
}

double RealTimeFactor::share() const {
    return passed_s_ > 0.0 ? std::clamp(flown_s_ / passed_s_, 0.0, 1.0) : 1.0;
}

} // namespace octant::ui::window
