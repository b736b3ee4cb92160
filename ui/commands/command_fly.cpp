#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/flight/flight_loop.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/replay.h"
#include "ui/flight/sender.h"
#include "ui/flight/session.h"
#include "ui/report/packed_recording.h"
#include "ui/report/video_pipe.h"
#include "ui/settings/setting_rows.h"
#include "ui/settings/settings_file.h"
#include "ui/world/input_files.h"
#include "ui/world/world.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace octant::ui::commands {

using namespace command_line;

namespace scene = visuals::scene;

namespace {

struct FlyOptions : base::OutputOptions {
    settings::RunSettings settings;
    flight::RecordOptions record;
    report::RecordingFolder replayed;
    std::optional<flight::Replay> replay;
    std::vector<std::string> send;  ///< to whom
    std::vector<std::string> given; ///< names of the setting options on the command line
    bool if_new = false;
};

/// How the option of this name (FlyOptions::given) is typed: "--show no-shadows" for "--no-shadows".
std::string typed_option(const std::string& name) {
    for (const settings::SettingFamily& family : settings::setting_families()) {
        for (const auto& [key, setting] : family.keys) {
            if (name == fmt::format("--{}", setting)) { return fmt::format("{} {}", family.name, key); }
            if (name == fmt::format("--no-{}", setting)) { return fmt::format("{} no-{}", family.name, key); }
        }
    }
    return name;
}

/// Throws Error when the command line sets anything beside --replay that could change pictures.
void check_no_settings_with_replay(const FlyOptions& options) {
    constexpr std::array<std::string_view, 5> harmless{
        "--realtime", "--no-realtime", "--pictures", "--warm-up", "--order-cache"};
    for (const std::string& name : options.given) {
        if (std::ranges::find(harmless, name) == harmless.end()) {
            throw Error(fmt::format(
                "--replay: expected no option beside it that may change pictures, got {}", typed_option(name)));
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
        stopped = flight::fly_frames(options.settings.time, options.quiet, session, sender, recorder);
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
    flight::print_result(end, verdict, options.json);
    if (!end.fault.empty()) { throw Error(end.fault); }
    if (verdict && !verdict->is_same) { throw CheckFailed(); }
}

std::vector<Option> options_of(FlyOptions& options) {
    const auto replay_notes = std::make_shared<std::vector<std::string>>();
    std::vector<Option> table = with_output_options(options,
        {text_option("--record", "DIR", "folder for the recording and its report", options.record.folder),
            text_option("--video", "FILE.mp4", "write a video (needs ffmpeg)", options.record.video),
            {.name = "--replay",
                .form = "DIR",
                .meaning =
                    "repeat a recording frame by frame and check that states and pictures are identical; exit code 1 "
                    "if not",
                .read =
                    [&options, replay_notes](const Words& words) {
                        options.replayed = report::open_recording(words.front());
                        const std::filesystem::path& folder = options.replayed.path;
                        options.replay = flight::read_replay(folder);
                        options.record.replay_of = folder;
                        options.settings = settings::read_settings(folder / "run.json", replay_notes.get());
                    },
                .note = [replay_notes](const Words&) { return fmt::format("{}", fmt::join(*replay_notes, "; ")); }},
            advanced(list_option("--send", "PROTOCOL:HOST:PORT",
                "send the aircraft of each frame to another program, in real time; repeatable\n"
                "fdm: the first aircraft as FlightGear native FDM; xplane: as X-Plane DATA\n"
                "dis: all aircraft as DIS entity states; tacview:PORT: serve Tacview real-time telemetry\n"
                "cigi:HOST:PORT[:OWN]: all aircraft and the camera to a CIGI image generator that answers to port OWN "
                "[8005]; each frame waits for its picture, so that several generators show the same frame",
                Arity::Repeatable, options.send)),
            hidden(text_option("--machine-sharing,--swept", "HOW",
                "internal: how octant sweep shares the machine, for the report", options.record.machine_sharing)),
            advanced(flag("--if-new", "skip the flight if DIR already contains a recording of exactly this run",
                options.if_new))});
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
