#include "sim/base/error.h"
#include "sim/base/stopwatch.h"
#include "ui/base/data_files.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/report/statistics.h"
#include "ui/window/viewer.h"
#include "ui/world/input_files.h"
#include "ui/world/world.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::commands {

using namespace command_line;
using window::Viewer;
using window::ViewOptions;

void add_window_options(std::vector<Option>& table, ViewOptions& view, const std::vector<FamilyKey>& more) {
    std::vector<FamilyKey> keys{{"full-screen", flag("--full-screen", "fill the screen (F11)", view.full_screen)},
        {"vsync", with_shown_default(
                      "true", flag("--vsync,!--no-vsync",
                                  "one picture per refresh of the display; else as many as possible", view.vsync))},
        {"panels",
            with_shown_default("true", flag("--panels,!--no-panels", "begin with panels shown (Tab)", view.panels))}};
    keys.insert(keys.end(), more.begin(), more.end());
    add_family(table, {.name = "--window", .form = "[no-]KEY,...", .meaning = "the window:", .shown = Shown::InHelpAll},
        std::move(keys));
}

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

ViewOptions for_bench(ViewOptions options) {
    options.vsync = false;
    options.config_folder.clear();
    return options;
}

/// Takes turns between the three ways, frame by frame, and times each whole turn, from the simulation to the picture
/// read or shown with everything that the window does in between. Opens a window. Throws Error.
WindowBench bench_window(const ViewOptions& options, int frames, bool quiet) {
    Viewer viewer(for_bench(options));
    settings::RunSettings settings = viewer.session().settings();
    settings.drawing.context = settings::ContextKind::OsMesa;
    flight::Session session(settings);
    const int count = std::min(frames + warm_up_frames, session.frames());
    viewer.state().playback.speed = 0.5;
    viewer.state().open.timing = true;
    std::vector<double> without;
    std::vector<double> hidden;
    std::vector<double> open;
    base::Progress progress("window", count, quiet);
    for (int frame = 0; frame < count; ++frame) {
        const auto timed = [&](std::vector<double>& all, const auto& work) {
            const Stopwatch watch;
            work();
            if (frame >= warm_up_frames) { all.push_back(watch.ms()); }
        };
        timed(without, [&] { session.draw(frame); });
        viewer.state().open.shown = false;
        timed(hidden, [&] { viewer.run_frame(); });
        viewer.state().open.shown = true;
        timed(open, [&] { viewer.run_frame(); });
        progress.show(frame + 1);
    }
    progress.finish();
    return {times_of(without), times_of(hidden), times_of(open)};
}

base::JsonValue figures_of(const WindowTimes& times) {
    return {{"median_ms", times.median_ms}, {"p99_ms", times.p99_ms}};
}

void print_bench_as_json(const WindowBench& bench) {
    base::print_value({{"without_window", figures_of(bench.without)}, {"panels_hidden", figures_of(bench.hidden)},
                          {"panels_open", figures_of(bench.open)}},
        true);
}

void print_bench(const WindowBench& bench) {
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

void view(const ViewOptions& options, const std::vector<std::string>& given, bool quiet) {
    Viewer viewer(options);
    const world::World& world = viewer.session().world();
    for (const std::string& note : world.notes) { base::print_note(quiet, "note: " + note); }
    for (const std::string& note : world::near_detail_warnings(world, options.settings.ground, given)) {
        base::print_note(quiet, "note: " + note);
    }
    viewer.run(options.settings.time.frames, quiet);
}

struct ViewWork : base::OutputOptions {
    ViewOptions view;
    std::vector<std::string> given; ///< names of the setting options on the command line
    std::optional<int> bench;       ///< frames to time instead of a flight to see
};

void view_or_bench(ViewWork work) {
    if (work.view.settings.path.name == settings::live_path) {
        throw Error("path: expected a path or a track, got 'live', which others fly: octant listen");
    }
    if (work.json && !work.bench) {
        throw Error("--json: expected --window bench=FRAMES beside it, as a window prints no figures, got none");
    }
    work.view.config_folder = base::configuration_folder();
    work.view.settings = world::with_absolute_paths(work.view.settings);
    if (work.bench) {
        const WindowBench bench = bench_window(work.view, *work.bench, work.quiet);
        work.json ? print_bench_as_json(bench) : print_bench(bench);
    } else {
        view(work.view, work.given, work.quiet);
    }
}

std::vector<Option> options_of(ViewWork& work) {
    ViewOptions& view = work.view;
    std::vector<Option> table = with_output_options(
        work, {flag("--by-hand", "start under manual control", view.by_hand),
                  text_option("--record", "DIR", "record from the first frame into this folder", view.record),
                  advanced(list_option("--send", "PROTOCOL:HOST:PORT",
                      "send aircraft to another program, as octant fly --send", Arity::Repeatable, view.send))});
    add_window_options(table, view,
        {{"recordings", with_shown_default(view.recordings_folder.string(),
                            text_option("--records-into", "DIR", "folder for recordings (F9) and screenshots (F12)",
                                view.recordings_folder))},
            {"bench", value_option({"bench", "FRAMES",
                                       "time N frames without a window, with hidden panels and with open panels, in "
                                       "turn, instead of a flight",
                                       1, 100000},
                          work.bench)}});
    add_setting_options(table, view.settings, &work.given);
    return table;
}

} // namespace

Command view_command() {
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
                  "rate, seconds, pictures, warm-up and realtime count when octant fly repeats a recording; --frames "
                  "closes the "
                  "window after N frames. octant fly needs no display.",
        .run = [work] { view_or_bench(*work); }};
}

} // namespace octant::ui::commands
