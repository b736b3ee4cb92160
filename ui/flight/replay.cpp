#include "ui/flight/replay.h"

#include "sim/base/error.h"
#include "ui/base/data_files.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/flight/live_flight.h"
#include "ui/flight/packet_file.h"
#include "ui/report/frame_csv.h"
#include "ui/report/frame_record.h"
#include "ui/report/run_file.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace octant::ui::flight {

namespace {

/// More than any control asks for.
constexpr int max_triangles = 100000000;

std::string hash_verdict(const Replay& replay, const std::string& recorded, const std::string& now) {
    if (!replay.ended) { return "unknown"; }
    return recorded == now ? "same" : "other";
}

} // namespace

Replay read_replay(const std::filesystem::path& folder) {
    constexpr std::array<std::string_view, 1> target_columns{"triangle_target"};
    const report::RunFile run = report::read_run_file(folder / "run.json");
    const auto file = folder / "frames.csv";
    const report::FrameFile rows = report::read_frame_csv(file, target_columns);
    if (rows.records.empty()) { throw_error_in(file, "expected the rows of a flight, got none"); }
    const bool in_a_window =
        std::ranges::any_of(run.facts, [](const auto& fact) { return fact.first == report::window_fact; });
    if (in_a_window) {
        throw_error_in(folder / "run.json",
            "expected a recording of octant fly, got one of a window, whose pictures follow the "
            "clock; --settings with this file repeats its flight");
    }
    Replay replay{folder, {}, run.ended, run.state_hash, run.picture_hash};
    for (const report::FrameRecord& row : rows.records) {
        const auto frame = static_cast<int>(replay.quality_targets.size());
        if (row.frame != frame) {
            throw_error_at(file, frame + 2, fmt::format("expected frame {}, got {}", frame, row.frame));
        }
        if (row.triangle_target < 1 || row.triangle_target > max_triangles) {
            throw_error_at(file, frame + 2,
                fmt::format("expected a triangle_target from 1 to {}, got {}", max_triangles, row.triangle_target));
        }
        replay.quality_targets.push_back(
            {row.triangle_target, row.smooth_target < 0 ? std::nullopt : std::optional(row.smooth_target)});
    }
    return replay;
}

void check_frames(const Replay& replay, int frames) {
    const auto rows = static_cast<int>(replay.quality_targets.size());
    if (rows > frames) {
        throw_error_at(replay.folder / "frames.csv", frames + 2,
            fmt::format("expected at most the {} frames of this flight, got {}", frames, rows));
    }
}

ReplayComparison compare_with_recording(const Replay& replay, std::uint64_t state_hash, std::uint64_t picture_hash) {
    ReplayComparison verdict;
    verdict.state_hash = hash_verdict(replay, replay.state_hash, fmt::format("{:016x}", state_hash));
    verdict.picture_hash = hash_verdict(replay, replay.picture_hash, fmt::format("{:016x}", picture_hash));
    verdict.is_same = verdict.state_hash == "same" && verdict.picture_hash == "same";
    const std::string name = base::with_path_aliases(replay.folder.string());
    verdict.line = replay.ended
                       ? fmt::format("{} states, {} pictures as {}", verdict.state_hash, verdict.picture_hash, name)
                       : fmt::format("nothing to compare with: {} was cut short after {} frames and has no hashes",
                             name, replay.quality_targets.size());
    return verdict;
}

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
