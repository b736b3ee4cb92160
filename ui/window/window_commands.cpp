#include "ui/window/window_commands.h"

#include "sim/base/error.h"
#include "ui/base/data_files.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/base/stopwatch.h"
#include "ui/commands/listen.h"
#include "ui/commands/setting_option.h"
#include "ui/report/statistics.h"
#include "ui/window/viewer.h"
#include "ui/world/entity_table.h"
#include "ui/world/input_files.h"
#include "ui/world/world.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::window {

namespace {

/// Median and 99th percentile of the frame times of one way to show a flight.
struct WindowTimes {
    double median_ms = 0.0;
    double p99_ms = 0.0;
};

/// Frame times of one flight without a window, in a window with hidden panels, and with open panels.
struct WindowBench {
    WindowTimes without;
    WindowTimes hidden;
    WindowTimes open;
};

constexpr int warm_up_frames = 20;

WindowTimes times_of(const std::vector<double>& frame_ms) {
    const report::Statistics statistics = report::statistics_of_times(frame_ms);
    return {statistics.p50_ms, statistics.p99_ms};
}

/// Takes turns between the three ways, frame by frame, and times each whole turn, from the simulation to the picture
/// read or shown with everything that the window does in between. Opens a window. Throws Error.
WindowBench bench_window(ViewOptions options, int frames, bool quiet) {
    options.vsync = false;
    options.config_folder.clear();
    Viewer viewer(options);
    settings::RunSettings settings = viewer.session().settings();
    settings.drawing.context = settings::ContextKind::OsMesa;
    flight::Session session(settings);
    const int count = std::min(frames + warm_up_frames, session.frames());
    viewer.state().playback.speed = 0.5;
    viewer.state().open.timing = true;
    std::array<std::vector<double>, 3> times;
    base::Progress progress("window", count, quiet);
    for (int frame = 0; frame < count; ++frame) {
        const auto timed = [&](std::vector<double>& all, const auto& work) {
            const base::Stopwatch watch;
            work();
            if (frame >= warm_up_frames) { all.push_back(watch.ms()); }
        };
        timed(times[0], [&] { session.draw(frame); });
        viewer.state().open.shown = false;
        timed(times[1], [&] { viewer.run_frame(); });
        viewer.state().open.shown = true;
        timed(times[2], [&] { viewer.run_frame(); });
        progress.show(frame + 1);
    }
    progress.finish();
    return {times_of(times[0]), times_of(times[1]), times_of(times[2])};
}

base::JsonValue figures_of(const WindowTimes& times) {
    return {{"median_ms", times.median_ms}, {"p99_ms", times.p99_ms}};
}

void print_bench(const WindowBench& bench, bool as_json) {
    if (as_json) {
        base::print_value({{"without_window", figures_of(bench.without)}, {"panels_hidden", figures_of(bench.hidden)},
                              {"panels_open", figures_of(bench.open)}},
            true);
        return;
    }

    const auto line = [](std::string_view name, const WindowTimes& times, const std::string& rest) {
        std::fputs(
            fmt::format("{:<28} {:>9.2f} {:>9.2f}  {}\n", name, times.median_ms, times.p99_ms, rest).c_str(), stdout);
    };
    std::fputs(fmt::format("{:<28} {:>9} {:>9}\n", "", "median ms", "p99 ms").c_str(), stdout);
    line("without a window", bench.without, "");
    line("window, panels hidden", bench.hidden,
        fmt::format("{:.2f} of it", bench.hidden.median_ms / bench.without.median_ms));
    line("window, two panels open", bench.open,
        fmt::format("{:+.2f} ms", bench.open.median_ms - bench.hidden.median_ms));
}

/// Shows pictures until a person leaves, a stop signal comes or so many were shown; then ends the recording.
void run_window(Viewer& viewer, const std::optional<int>& max_frames, bool quiet) {
    const base::StopSignals stop_signals;
    int frames = 0;
    while (viewer.run_frame() && !base::StopSignals::received()) {
        if (max_frames && ++frames >= *max_frames) { break; }
    }
    if (const auto report = viewer.finish_recording()) { base::print_note(quiet, *report); }
}

void view(const ViewOptions& options, const std::vector<std::string>& given, bool quiet) {
    Viewer viewer(options);
    const world::World& world = viewer.session().world();
    for (const std::string& note : world.notes) { base::print_note(quiet, "note: " + note); }
    for (const std::string& note : world::near_detail_warnings(world, options.settings.ground, given)) {
        base::print_note(quiet, "note: " + note);
    }
    run_window(viewer, options.settings.time.frames, quiet);
}

struct ViewWork {
    ViewOptions view;
    std::vector<std::string> given; ///< names of the settings' options that stand there
    std::optional<int> bench;       ///< frames to time instead of a flight to see
    bool json = false;
    bool quiet = false;
};

void view_or_bench(ViewWork work) {
    if (work.view.settings.path.name == settings::live_path) {
        throw Error("path: expected a path or a track, got 'live', which others fly: octant listen");
    }
    if (work.json && !work.bench) {
        throw Error("--json: expected --bench beside it, as a window prints no figures, got none");
    }
    work.view.config_folder = base::configuration_folder();
    work.view.settings = world::with_absolute_paths(work.view.settings);
    if (work.bench) {
        print_bench(bench_window(work.view, *work.bench, work.quiet), work.json);
    } else {
        view(work.view, work.given, work.quiet);
    }
}

/// The options of every window.
void add_window_options(std::vector<commands::Option>& table, ViewOptions& view) {
    using commands::flag;
    table.push_back(flag("--full-screen", "fill the screen (F11)", view.full_screen));
    table.push_back(flag("--vsync,!--no-vsync", "limit to the display's refresh rate", view.vsync));
    table.push_back(flag("--panels,!--no-panels", "begin with panels shown (Tab)", view.panels));
}

std::vector<commands::Option> options_of(ViewWork& work) {
    using namespace commands;
    ViewOptions& view = work.view;
    std::vector<Option> table = {flag("--by-hand", "start in manual flight", view.by_hand),
        text_option("--record", "DIR", "record from the first frame into this folder", view.record),
        with_shown_default(view.recordings_folder.string(),
            text_option(
                "--records-into", "DIR", "where recordings (F9) and screenshots (F12) go", view.recordings_folder)),
        value_option({"bench", "FRAMES",
                         "time so many frames without a window, with its panels hidden and with panels open, "
                         "in turn",
                         1, 100000},
            work.bench),
        list_option("--send", "fdm|dis|xplane|cigi|tacview:HOST:PORT",
            "send each picture's aircraft to another program, as octant fly --send", Arity::Repeatable, view.send),
        flag("--json", "the times of --bench as JSON", work.json), flag("--quiet", "no notes", work.quiet)};
    add_window_options(table, view);
    add_setting_options(table, view.settings, &work.given);
    return table;
}

} // namespace

commands::Command view_command() {
    auto work = std::make_shared<ViewWork>();
    work->view.settings.path.terrain = "canyon";
    work->view.recordings_folder = ".";
    return {.name = "view",
        .summary = "Flies along a path or by hand in a window; F1 there lists its keys",
        .options = options_of(*work),
        .footer = "Examples:\n"
                  "  octant view\n"
                  "  octant view pop-up --aircraft f15 --terrain map.tif --view cockpit\n"
                  "  octant view --by-hand --aircraft 500md --view chase --inset tower\n"
                  "  octant view --settings my-flight/run.json\n"
                  "Of the settings, rate, seconds, pictures, warm-up and realtime count when a "
                  "recording is flown\n"
                  "again by octant fly; --frames closes the window after so many.\n"
                  "No display? octant fly needs none.",
        .run = [work] { view_or_bench(*work); }};
}

namespace {

constexpr int default_vehicles = 16;

struct ListenWork {
    commands::ListenOptions listen;
    ViewOptions view;
    bool headless = false;
};

void listen_in_window(ListenWork work) {
    if (work.listen.listener.live.step) { throw Error("--step: expected --headless beside it, got none"); }
    if (work.listen.record.video) { throw Error("--video: expected --headless beside it, got none"); }
    work.view.settings = work.listen.settings;
    work.view.config_folder = base::configuration_folder();
    work.view.listener = work.listen.listener;
    work.view.send = work.listen.send;
    work.view.record = work.listen.record.folder;
    work.view.quiet = work.listen.quiet;
    Viewer viewer(work.view);
    run_window(viewer, work.view.settings.time.frames, work.listen.quiet);
}

void listen(ListenWork work) {
    settings::RunSettings& settings = work.listen.settings;
    settings.path.name = settings::live_path;
    std::vector<std::string>& aircraft = settings.path.aircraft;
    if (work.listen.entities) {
        if (work.listen.vehicles) {
            throw Error("--vehicles: expected no --entities beside it, whose count says how many");
        }
        world::EntityTable table = world::read_entity_table(*work.listen.entities);
        aircraft = std::move(table.aircraft);
        work.listen.listener.live.shapes = std::move(table.types);
    } else {
        const auto vehicles = static_cast<std::size_t>(work.listen.vehicles.value_or(default_vehicles));
        const std::string last = aircraft.back();
        aircraft.resize(std::max(aircraft.size(), vehicles), last);
    }
    settings = world::with_absolute_paths(settings);
    if (work.headless) {
        commands::listen_without_window(work.listen);
    } else {
        listen_in_window(std::move(work));
    }
}

std::vector<commands::Option> options_of(ListenWork& work) {
    using namespace commands;
    ListenOptions& listen = work.listen;
    std::vector<Option> table = {flag("--headless", "no window: pictures, video and recording alone", work.headless),
        text_option("--record", "DIR",
            "write the recording and its report into this folder; in a window its view stays as it "
            "is until F9 ends it",
            listen.record.folder),
        text_option("--video", "FILE.mp4", "with --headless: write a video (needs ffmpeg)", listen.record.video),
        flag("--json", "with --headless: summary as JSON, with packet counts of every vehicle", listen.json)};
    add_window_options(table, work.view);
    std::vector<Option> shared = listen_options(listen);
    table.insert(table.end(), std::make_move_iterator(shared.begin()), std::make_move_iterator(shared.end()));
    return table;
}

} // namespace

commands::Command listen_command() {
    auto work = std::make_shared<ListenWork>();
    work->view.recordings_folder = ".";
    return {.name = "listen",
        .summary =
            "Displays aircraft that other programs control: FlightGear FDM, X-Plane, CIGI, MAVLink, DIS, lines of "
            "numbers",
        .options = options_of(*work),
        .footer = "Examples:\n"
                  "  octant listen\n"
                  "  octant listen --terrain map.tif --view cockpit --delay 0.1\n"
                  "  octant listen --headless --seconds 60 --record my-flight --video flight.mp4\n"
                  "  my-script | octant listen --from - --headless --step --record steps\n"
                  "JSBSim: JSBSim --script=... --realtime --logdirectivefile=FILE, in FILE:\n"
                  "  <output name=\"127.0.0.1\" type=\"FLIGHTGEAR\" port=\"5550\" "
                  "protocol=\"UDP\" rate=\"60\"/>\n"
                  "ArduPilot: sim_vehicle.py -v ArduPlane\n"
                  "FlightGear: fgfs --native-fdm=socket,out,60,127.0.0.1,5550,udp\n"
                  "X-Plane: data output by UDP of groups 3, 17, 18, 20 and 21 to port 49003; or "
                  "octant listen --xplane HOST\n"
                  "Ctrl-C ends it; a recording is then completed.",
        .run = [work] { listen(*work); }};
}

} // namespace octant::ui::window
