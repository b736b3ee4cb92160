#include "sim/base/error.h"
#include "ui/commands.h"
#include "ui/flight_recorder.h"
#include "ui/input_files.h"
#include "ui/progress.h"
#include "ui/report/statistics.h"
#include "ui/session.h"
#include "ui/settings_options.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

namespace octant::ui {

namespace scene = visuals::scene;

namespace {

struct FlyOptions {
    scene::Settings settings;
    RecordOptions record;
    bool json = false;
    bool quiet = false;
    bool if_new = false;
};

/// Waits until the wall clock reaches the frame's simulated time.
void wait_for(const Stopwatch& since_start, double time_s) {
    const double left_s = time_s - since_start.s();
    if (left_s > 0.0) {
        std::this_thread::sleep_for(std::chrono::duration<double>(left_s));
    }
}

void print_summary(const FlightEnd& end, bool json) {
    if (json) {
        nlohmann::ordered_json object;
        for (const report::Figure& figure : report::figures()) {
            const double value = figure.value(end.statistics);
            if (figure.decimals == 0) {
                object[std::string(figure.key)] = static_cast<int>(value);
            } else {
                object[std::string(figure.key)] = value;
            }
        }
        object["state_hash"] = fmt::format("{:016x}", end.state_hash);
        object["picture_hash"] = fmt::format("{:016x}", end.picture_hash);
        std::fputs(fmt::format("{}\n", object.dump(2)).c_str(), stdout);
        return;
    }
    for (const report::Figure& figure : report::figures()) {
        std::fputs(
            fmt::format(
                "{:<28} {:.{}f}\n", figure.name, figure.value(end.statistics), figure.decimals)
                .c_str(),
            stdout);
    }
    std::fputs(
        fmt::format(
            "{:<28} {:016x}\n{:<28} {:016x}\n",
            "state hash",
            end.state_hash,
            "picture hash",
            end.picture_hash)
            .c_str(),
        stdout);
}

void fly(FlyOptions options) {
    options.settings = with_absolute_files(options.settings);
    if (options.if_new && !options.record.folder) {
        throw Error("--if-new: expected --record DIR beside it, got none");
    }
    if (options.if_new && is_recorded(options.record, options.settings)) {
        say(options.quiet, fmt::format("{} is done already", options.record.folder->string()));
        return;
    }
    Session session(options.settings);
    for (const std::string& note : session.world().notes) {
        say(options.quiet, fmt::format("note: {}", note));
    }
    FlightRecorder recorder(options.record, options.settings, session);
    Progress progress(session.world().flight.title, session.frames(), options.quiet);
    const Stopwatch since_start;
    for (int frame = 0; frame < session.frames(); ++frame) {
        if (options.settings.realtime) {
            wait_for(since_start, frame / session.rate_hz());
        }
        report::FrameRecord record = session.draw(frame);
        recorder.add(record, session);
        progress.show(frame + 1, fmt::format("{:.1f} ms", record.frame_ms));
    }
    progress.finish();
    const FlightEnd end = recorder.finish(session);
    for (const std::string& note : end.notes) {
        say(options.quiet, note);
    }
    for (const std::string& missing : end.missing) {
        say(false, missing);
    }
    if (end.statistics.frames == 0) {
        say(options.quiet,
            fmt::format(
                "note: all {} frames are warm-up, so there are no figures; --warm-up 0 counts them",
                session.frames()));
    }
    print_summary(end, options.json);
    if (!end.fault.empty()) {
        throw Error(end.fault);
    }
}

} // namespace

void add_fly_command(CLI::App& program) {
    auto options = std::make_shared<FlyOptions>();
    CLI::App* command = program.add_subcommand(
        "fly", "Flies a path without a window, as fast as it can, and records it");
    command
        ->add_option_function<std::string>(
            "--record",
            [options](const std::string& folder) { options->record.folder = folder; },
            "write the recording and its report into this folder")
        ->type_name("DIR");
    command
        ->add_option_function<std::string>(
            "--video",
            [options](const std::string& file) { options->record.video = file; },
            "write a video (needs ffmpeg; frame times then include the encoder's load)")
        ->type_name("FILE.mp4");
    command->add_flag(
        "--if-new", options->if_new, "do nothing when DIR holds this very run already");
    command->add_flag("--json", options->json, "summary as JSON");
    command->add_flag("--quiet", options->quiet, "no progress, no notes");
    add_setting_options(*command, options->settings, true);
    command->footer(
        "Examples:\n"
        "  octant fly straight\n"
        "  octant fly pop-up --aircraft f15 --terrain canyon --view chase --record my-flight\n"
        "  octant fly turn --aircraft 500md --terrain map.tif --height-mode follow --video "
        "turn.mp4\n"
        "  octant fly --settings my-flight/run.json --record the-same");
    command->callback([options] { fly(*options); });
}

} // namespace octant::ui
