#include "ui/window/viewer.h"
#include "ui/world/input_files.h"

#include <fmt/format.h>

// A viewer whose aircraft others fly.

namespace octant::ui::window {

/// Lets others fly what is loaded now, where there are others.
void Viewer::follow_others() {
    if (listener_) {
        listener_->attach(*session_);
        state_.playback.playing = true;
    }
}

/// Before the first picture: a replay begins there, too. Pictures are drawn again without a window.
void Viewer::start_live_recording(const std::filesystem::path& folder) {
    settings::RunSettings settings = world::with_absolute_files(session_->settings());
    settings.drawing.context = settings::ContextKind::OsMesa;
    live_recorder_.emplace(
        flight::RecordOptions{.folder = folder, .video = {}, .replay_of = {}}, settings, *session_);
    listener_->record_into(folder);
    session_->simulation().start_log();
    state_.recording = folder;
    say(fmt::format("recording into {}: the view stays as it is", folder.string()));
}

std::string Viewer::finish_live_recording() {
    listener_->finish();
    const flight::FlightEnd end = live_recorder_->finish(*session_);
    live_recorder_.reset();
    state_.recording.reset();
    session_->simulation().stop_log();
    return end.notes.back();
}

/// Shows what has come up to now.
void Viewer::draw_live() {
    const double time_s = *listener_->take(*session_); // not in steps: always a picture
    state_.wanted.air = session_->settings().air;      // a host may have told another
    session_->aim_at_window(input_->size_px());
    report::FrameRecord record = session_->draw_at(time_s, std::nullopt);
    listener_->finish_picture(record);
    if (live_recorder_) {
        session_->read_picture();
        live_recorder_->add(record, *session_);
    }
    const double now_s = clock_.s();
    record.missed = presented_s_ > 0.0 && now_s - presented_s_ > 1.5 / refresh_hz_ ? 1 : 0;
    presented_s_ = now_s;
    sender_.send(*session_);
    state_.history.add(record);
}

} // namespace octant::ui::window
