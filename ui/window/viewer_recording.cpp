#include "sim/base/error.h"
#include "ui/flight/flight_recorder.h"
#include "ui/window/viewer.h"
#include "ui/world/input_files.h"

#include <fmt/format.h>

// A viewer's recordings: of a path, of a flight by hand and of what others fly.

namespace octant::ui::window {

namespace fs = std::filesystem;

/// Before the first picture: a replay begins there, too. Pictures are drawn again without a window.
void Viewer::start_live_recording(const fs::path& folder) {
    settings::RunSettings settings = world::with_absolute_paths(session_->settings());
    settings.drawing.context = settings::ContextKind::OsMesa;
    live_recorder_.emplace(flight::RecordOptions{.folder = folder, .video = {}, .replay_of = {}, .batch_context = {}},
        settings, *session_);
    listener_->start_packet_recording(folder);
    state_.recording = folder;
    show_message(fmt::format("recording into {}: the view stays as it is", folder.string()));
}

std::string Viewer::finish_live_recording() {
    listener_->finish();
    const flight::FlightResult end = live_recorder_->finish(*session_);
    live_recorder_.reset();
    state_.recording.reset();
    return end.notes.back();
}

void Viewer::start_recording(const fs::path& folder) {
    if (listener_) {
        start_live_recording(folder);
        return;
    }
    recording_.emplace(folder, *session_);
    state_.recording = recording_->folder();
    show_message(fmt::format("recording into {}", folder.string()));
}

std::optional<std::string> Viewer::finish_recording() {
    if (live_recorder_) { return finish_live_recording(); }
    if (!recording_) { return std::nullopt; }
    const std::string line = recording_->finish(*session_);
    recording_.reset();
    state_.recording.reset();
    return line;
}

void Viewer::toggle_recording() {
    if (listener_ && !live_recorder_) {
        show_message("flights of others are recorded from their first picture on: octant listen --record");
        return;
    }
    try {
        if (const auto report = finish_recording()) {
            show_message(*report);
        } else {
            start_recording(unused_path("flight", ""));
        }
    } catch (const Error& fault) {
        drop_recording();
        show_message(fault.what());
    }
}

/// Gives up the recording. The files that it has written so far stay.
void Viewer::drop_recording() {
    recording_.reset();
    live_recorder_.reset();
    if (listener_) { listener_->drop_recording(); }
    state_.recording.reset();
    session_->simulation().stop_log();
}

void Viewer::record_frame(const report::FrameRecord& record) {
    try {
        if (recording_) { recording_->add(record, *session_); }
        if (live_recorder_) {
            session_->read_picture();
            live_recorder_->add(record, *session_);
        }
    } catch (const Error& fault) {
        drop_recording();
        show_message(fault.what());
    }
}

} // namespace octant::ui::window
