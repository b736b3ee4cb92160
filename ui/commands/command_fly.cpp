#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/commands/flight_summary.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/packet_replay.h"
#include "ui/flight/sender.h"
#include "ui/flight/session.h"
#include "ui/report/packed_recording.h"
#include "ui/report/video_pipe.h"
#include "ui/settings/frame_part.h"
#include "ui/settings/settings_file.h"
#include "ui/world/input_files.h"
#include "ui/world/world.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>

namespace octant::ui::commands {

using namespace command_line;

namespace scene = visuals::scene;

namespace {

struct FlyOptions {
    settings::RunSettings settings;
    flight::RecordOptions record;
    std::optional<flight::Replay> replay;
    std::vector<std::string> send;  ///< to whom
    std::vector<std::string> given; ///< names of the setting options on the command line
    bool json = false;
    bool quiet = false;
    bool if_new = false;
};

/// Waits until the wall clock reaches the frame's simulated time.
void wait_for(const Stopwatch& since_start, double time_s) {
    const double left_s = time_s - since_start.s();
    if (left_s > 0.0) { std::this_thread::sleep_for(std::chrono::duration<double>(left_s)); }
}

/// Throws Error when the command line sets anything beside --replay that could change pictures.
void check_no_settings_with_replay(const FlyOptions& options) {
    constexpr std::array<std::string_view, 4> harmless{"--realtime", "--pictures", "--warm-up", "--order-cache"};
    for (const std::string& name : options.given) {
        if (std::ranges::find(harmless, name) == harmless.end()) {
            throw Error(fmt::format("--replay: expected no option beside it that may change pictures, got {}", name));
        }
    }
}

/// Throws Error where options contradict each other.
void check_options(const FlyOptions& options) {
    if (options.if_new && !options.record.folder) {
        throw Error("--if-new: expected --record DIR beside it, got none");
    }
    if (options.record.video) { report::check_video(*options.record.video); }
    if (!options.replay) { return; }
    check_no_settings_with_replay(options);
    if (options.if_new) { throw Error("--if-new: expected no --replay beside it, got one"); }
    if (options.settings.time.part) {
        throw Error("--replay: expected a recording of a whole flight, got one of a part");
    }
    if (options.record.folder && is_same_file(*options.record.folder, options.replay->folder)) {
        throw Error(fmt::format(
            "--record: expected another folder than that of --replay, got {}", options.record.folder->string()));
    }
}

/// Makes the session repeat the quality targets of the recording's frames. Throws Error if they do not fit it.
void start_replay(const flight::Replay& replay, flight::Session& session, bool quiet) {
    flight::check_frames(replay, session.frames());
    if (static_cast<int>(replay.quality_targets.size()) < session.frames()) {
        base::print_note(quiet, fmt::format("note: {} has {} of {} frames; these are flown", replay.folder.string(),
                                    replay.quality_targets.size(), session.frames()));
    }
    session.replay(replay.quality_targets);
}

/// Every frame of the session, recorded, until a signal comes. What ended the flight before its last frame, empty =
/// nothing did.
std::string fly_frames(
    const FlyOptions& options, flight::Session& session, flight::Sender& sender, flight::FlightRecorder& recorder) {
    const std::optional<std::string>& part = options.settings.time.part;
    const int first = part ? session.begin_frame_range(*settings::part_from_text(*part)).first : 0;
    const int count = session.frames() - first;
    base::Progress progress(session.world().flight.title, count, options.quiet);
    for (const std::string& line : sender.wait_for_channels(session)) { base::print_note(false, line); }
    const Stopwatch since_start;
    int frame = first;
    for (; frame < session.frames() && !(base::StopSignals::received() && frame > first); ++frame) {
        const double due_s = (frame - first) / session.rate_hz();
        if (options.settings.time.realtime) { wait_for(since_start, due_s); }
        report::FrameRecord record = session.draw(frame);
        if (options.settings.time.realtime) {
            const double late_s = since_start.s() - due_s;
            record.latency_ms = 1000.0 * late_s;
            record.missed = late_s > 1.0 / session.rate_hz() ? 1 : 0;
        }
        sender.send(session);
        record.skew_frames = sender.wait_for_pictures();
        recorder.add(record, session);
        progress.show(frame + 1 - first, fmt::format("{:.1f} ms", record.frame_ms));
    }
    progress.finish();
    for (const std::string& line : sender.channel_lines()) { base::print_note(false, line); }
    return frame == session.frames()
               ? std::string()
               : fmt::format("{} after {} of {} frames", base::StopSignals::name(), frame - first, count);
}

/// What the automatic share of smooth polygons came to.
std::string shading_note(const visuals::shading::ShadingState& shading) {
    if (shading.has_no_gain) { return "shading: flat polygons are not measurably faster here, so all are smooth"; }
    return fmt::format("shading: {} of {} polygons smooth; frames take {:.2f} ms with all flat, {:.2f} ms more "
                       "with all smooth",
        shading.smooth, shading.polygons, shading.fit.ms[0] + shading.fit.ms[1], shading.fit.ms[2]);
}

void fly(FlyOptions options) {
    check_options(options);
    options.settings.time.realtime = options.settings.time.realtime || !options.send.empty();
    const bool live = options.settings.path.name == settings::live_path;
    if (live && !options.replay) {
        throw Error("path: expected a path or a track, got 'live', which others fly: octant listen");
    }
    options.settings = world::with_absolute_paths(options.settings);
    if (options.if_new && flight::is_already_recorded(options.record, options.settings)) {
        base::print_note(options.quiet, fmt::format("{} is done already", options.record.folder->string()));
        return;
    }
    flight::Sender sender(options.send);
    flight::Session session(options.settings);
    for (const std::string& note : session.world().notes) {
        base::print_note(options.quiet, fmt::format("note: {}", note));
    }
    for (const std::string& note :
        world::near_detail_warnings(session.world(), options.settings.ground, options.given)) {
        base::print_note(options.quiet, fmt::format("note: {}", note));
    }
    if (options.replay && !live) { start_replay(*options.replay, session, options.quiet); }
    const base::StopSignals stop_signals;
    flight::FlightRecorder recorder(options.record, options.settings, session);
    std::string stopped;
    flight::PacketReplay packets;
    if (live) {
        packets = flight::replay_packets(*options.replay, session, recorder, options.quiet);
        stopped = packets.stopped;
    } else {
        stopped = fly_frames(options, session, sender, recorder);
    }
    if (!stopped.empty()) { base::print_note(options.quiet, fmt::format("note: ended by {}", stopped)); }
    const flight::FlightResult end = recorder.finish(session, stopped);
    if (session.shading() && !options.replay) { base::print_note(options.quiet, shading_note(*session.shading())); }
    for (const std::string& note : end.notes) { base::print_note(options.quiet, note); }
    for (const std::string& warning : end.missing_programs) { base::print_note(false, warning); }
    if (end.statistics.frames == 0) {
        base::print_note(options.quiet,
            fmt::format(
                "note: all {} frames are warm-up, so there are no figures; --warm-up 0 counts them", session.frames()));
    }
    std::optional<flight::ReplayComparison> verdict;
    if (options.replay && stopped.empty()) {
        verdict = flight::compare_with_recording(*options.replay, end.state_hash, end.picture_hash);
    }
    print_summary(end, verdict, options.json);
    if (!end.fault.empty()) { throw Error(end.fault); }
    if (verdict && !verdict->is_same) { throw CheckFailed(); }
}

std::vector<Option> options_of(FlyOptions& options) {
    std::vector<Option> table = {
        text_option("--record", "DIR", "folder for the recording and its report", options.record.folder),
        text_option("--video", "FILE.mp4", "write a video (needs ffmpeg)", options.record.video),
        {.name = "--replay",
            .form = "DIR",
            .meaning =
                "repeat a recording frame by frame and check that states and pictures are identical; exit code 1 "
                "if not",
            .read =
                [&options](const Words& words) {
                    const std::filesystem::path folder = report::recording_folder(words.front());
                    options.replay = flight::read_replay(folder);
                    options.record.replay_of = folder;
                    options.settings = settings::read_settings(folder / "run.json");
                }},
        advanced(list_option("--send", "PROTOCOL:HOST:PORT",
            "send the aircraft of each frame to another program, in real time; repeatable\n"
            "fdm: the first aircraft as FlightGear native FDM; xplane: as X-Plane DATA\n"
            "dis: all aircraft as DIS entity states; tacview:PORT: serve Tacview real-time telemetry\n"
            "cigi:HOST:PORT[:OWN]: all aircraft and the camera to a CIGI image generator that answers to port OWN "
            "[8005]; each frame waits for its picture, so that several generators show the same frame",
            Arity::Repeatable, options.send)),
        hidden(text_option("--swept", "HOW", "internal: how octant sweep shares the machine, for the report",
            options.record.batch_context)),
        advanced(flag(
            "--if-new", "skip the flight if DIR already contains a recording of exactly this run", options.if_new)),
        json_option(options.json), quiet_option(options.quiet)};
    add_setting_options(table, options.settings, &options.given);
    return table;
}

} // namespace

Command fly_command() {
    auto options = std::make_shared<FlyOptions>();
    return {.name = "fly",
        .summary = "Flies a path without a window, as fast as possible, and records it",
        .options = options_of(*options),
        .footer = "Examples:\n"
                  "  octant fly pop-up --aircraft f15 --terrain canyon --record my-flight\n"
                  "  octant fly turn --terrain map.tif --height-mode follow --video turn.mp4\n"
                  "  octant fly --settings my-flight/run.json --record the-same",
        .run = [options] { fly(*options); }};
}

} // namespace octant::ui::commands
