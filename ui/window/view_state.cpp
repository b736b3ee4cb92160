#include "ui/window/view_state.h"

#include "ui/report/statistics.h"

#include <algorithm>
#include <cmath>

namespace octant::ui::window {

void FrameHistory::add(const report::FrameRecord& record) {
    constexpr std::size_t renewed_every = 30;
    if (records_.size() == max_frames) { records_.erase(records_.begin()); }
    records_.push_back(record);
    if (added_++ % renewed_every == 0) { statistics_ = report::statistics_of(records_); }
}

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

double RealTimeFactor::share() const { return passed_s_ > 0.0 ? std::clamp(flown_s_ / passed_s_, 0.0, 1.0) : 1.0; }

Playback::TimeChange Playback::advance(double wall_s, bool open_ended) {
    if (!playing) { return TimeChange::Advanced; }
    time_s += wall_s * speed;
    if (open_ended || time_s <= end_s) { return TimeChange::Advanced; }
    if (loops) {
        time_s = begin_s;
        return TimeChange::Restarted;
    }
    time_s = end_s;
    playing = false;
    return TimeChange::Advanced;
}

void Playback::step_frame(double frame_s, bool open_ended) {
    playing = false;
    time_s = open_ended ? time_s + frame_s : std::min(time_s + frame_s, end_s);
}

void Playback::change_speed(int steps) { speed = std::clamp(speed * std::pow(2.0, steps), slowest, fastest); }

} // namespace octant::ui::window
