#include "sim/base/error.h"
#include "ui/base/progress.h"
#include "ui/window/viewer.h"

// A viewer whose aircraft others fly.

namespace octant::ui::window {

/// Lets others fly what is loaded now, where there are others.
void Viewer::restart_live_flight() {
    if (listener_) {
        listener_->attach(*session_);
        state_.playback.playing = true;
    }
}

/// The time that is shown now. A recording that can no longer be written ends; the window does not.
double Viewer::receive_packets() {
    try {
        return *listener_->take(*session_); // not in steps: always a picture
    } catch (const Error& fault) {
        if (!live_recorder_) { throw; }
        drop_recording();
        show_message(fault.what());
        return *listener_->take(*session_);
    }
}

/// Shows what has come up to now.
void Viewer::draw_live() {
    const double time_s = receive_packets();
    for (const std::string& line : listener_->take_new_messages()) { base::print_note(options_.quiet, line); }
    state_.next_settings.air = session_->settings().air; // a host may have told another
    const bool records = live_recorder_.has_value();
    session_->pictures().set_reads_before_presenting(records);
    session_->pictures().set_window_target(records && !painter_ ? glm::ivec2(0) : input_->size_px());
    report::FrameRecord record = session_->draw_at(time_s, std::nullopt);
    listener_->finish_picture(record);
    const double now_s = clock_.s();
    record.missed = presented_s_ > 0.0 && now_s - presented_s_ > 1.5 / refresh_hz_ ? 1 : 0;
    presented_s_ = now_s;
    sender_.send(*session_);
    state_.history.add(record);
    record_frame(record);
}

} // namespace octant::ui::window
