#include "ui/flight/packet_replay.h"

#include "sim/base/error.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/flight/live_flight.h"
#include "ui/flight/packet_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <utility>

namespace octant::ui::flight {

namespace {

/// Throws Error for packets whose entity types look like aircraft that the recording has not.
void check_shapes(const std::filesystem::path& folder, const LiveOptions& options, std::size_t count) {
    for (const auto& [type, aircraft] : options.shapes) {
        if (aircraft >= count) {
            throw_error_at(folder / packets_file_name, 1,
                fmt::format(
                    "expected entity type {} to be one of {} aircraft from 0, got number {}", type, count, aircraft));
        }
    }
}

} // namespace

PacketReplay replay_packets(const Replay& replay, Session& session, FlightRecorder& recorder, bool quiet) {
    const PacketFile file = read_packets(replay.folder);
    check_shapes(replay.folder, file.options, session.world().scene.aircraft.size());
    // A killed flight's last rows may be missing from either file.
    const std::size_t frames = std::min(file.frames.size(), replay.quality_targets.size());
    auto live = std::make_unique<LiveFlight>(file.options, session.world());
    session.set_state_source(*live);
    base::Progress progress(session.world().flight.title, static_cast<int>(frames), quiet);
    std::size_t frame = 0;
    for (; frame < frames && !(base::StopSignals::received() && frame > 0); ++frame) {
        const PacketFrame& of_frame = file.frames[frame];
        for (const sim::links::Datagram& packet : of_frame.packets) { live->take(packet); }
        if (of_frame.has_overlay_lines) { session.pictures().set_overlay_lines(of_frame.overlay_lines); }
        apply_host_visibility(*live, session);
        if (!of_frame.time_of_day.empty()) { set_time_of_day(of_frame.time_of_day, session); }
        report::FrameRecord record = session.draw_at(of_frame.time_s, std::nullopt);
        live->fill_in(record, of_frame.time_s);
        recorder.add(record, session);
        progress.show(static_cast<int>(frame) + 1, fmt::format("{:.1f} ms", record.frame_ms));
    }
    progress.finish();
    std::string stopped = frame == frames
                              ? std::string()
                              : fmt::format("{} after {} of {} frames", base::StopSignals::name(), frame, frames);
    return {std::move(live), std::move(stopped)};
}

} // namespace octant::ui::flight
