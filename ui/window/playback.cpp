#include "ui/window/playback.h"

#include <algorithm>
#include <cmath>

namespace octant::ui::window {

Playback::TimeChange Playback::advance(double wall_s, bool open_ended) {
    if (!playing) {
        return TimeChange::Advanced;
    }
    time_s += wall_s * speed;
    if (open_ended || time_s <= end_s) {
        return TimeChange::Advanced;
    }
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

void Playback::change_speed(int steps) {
    speed = std::clamp(speed * std::pow(2.0, steps), slowest, fastest);
}

} // namespace octant::ui::window
