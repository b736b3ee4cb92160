#include "ui/window/viewer.h"

// A viewer whose aircraft others fly.

namespace octant::ui::window {

/// Lets others fly what is loaded now, where there are others.
void Viewer::follow_others() {
    if (listener_) {
        listener_->attach(*session_);
        state_.playback.playing = true;
    }
}

/// Shows what has come up to now.
void Viewer::draw_live() {
    const double time_s = *listener_->take(*session_); // not in steps: always a picture
    session_->aim_at_window(input_->size_px());
    report::FrameRecord record = session_->draw_at(time_s, std::nullopt);
    listener_->finish_picture(record);
    const double now_s = clock_.s();
    record.missed = presented_s_ > 0.0 && now_s - presented_s_ > 1.5 / refresh_hz_ ? 1 : 0;
    presented_s_ = now_s;
    sender_.send(*session_);
    state_.history.add(record);
}

} // namespace octant::ui::window
