#include "ui/base/progress.h"
#include "ui/commands/commands.h"
#include "ui/commands/settings_options.h"
#include "ui/window/viewer.h"
#include "ui/window/window_bench.h"
#include "ui/world/input_files.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <string_view>

namespace octant::ui::commands {

namespace fs = std::filesystem;

namespace {

/// The user's own folder for what windows keep; empty where there is none.
fs::path configuration_folder() {
    const char* const own = std::getenv("XDG_CONFIG_HOME");
    if (own != nullptr && fs::path(own).is_absolute()) {
        return fs::path(own) / "octant";
    }
    const char* const home = std::getenv("HOME");
    return home == nullptr || *home == '\0' ? fs::path() : fs::path(home) / ".config" / "octant";
}

void print_bench(const window::WindowBench& bench) {
    const auto line = [](std::string_view name,
                         const window::WindowTimes& times,
                         const std::string& rest) {
        std::fputs(
            fmt::format("{:<28} {:>9.2f} {:>9.2f}  {}\n", name, times.median_ms, times.p99_ms, rest)
                .c_str(),
            stdout);
    };
    std::fputs(fmt::format("{:<28} {:>9} {:>9}\n", "", "median ms", "p99 ms").c_str(), stdout);
    line("without a window", bench.without, "");
    line(
        "window, panels hidden",
        bench.hidden,
        fmt::format("{:.2f} of it", bench.hidden.median_ms / bench.without.median_ms));
    line(
        "window, two panels open",
        bench.open,
        fmt::format("{:+.2f} ms", bench.open.median_ms - bench.hidden.median_ms));
}

void view(window::ViewOptions options, bool quiet) {
    window::Viewer viewer(options);
    for (const std::string& note : viewer.session().world().notes) {
        base::say(quiet, "note: " + note);
    }
    int frames = 0;
    while (viewer.turn()) {
        if (options.settings.time.frames && ++frames >= *options.settings.time.frames) {
            break;
        }
    }
    if (const auto report = viewer.finish_recording()) {
        base::say(quiet, *report);
    }
}

} // namespace

void add_view_command(CLI::App& program) {
    struct Options {
        window::ViewOptions view;
        int bench = 0;
        bool quiet = false;
    };

    auto options = std::make_shared<Options>();
    options->view.settings.path.terrain = "canyon";
    options->view.records_into = ".";
    CLI::App* command = program.add_subcommand(
        "view", "Flies along a path or by hand in a window; F1 there lists its keys");
    command->add_flag("--by-hand", options->view.by_hand, "in the pilot's hands from the start");
    command->add_flag("--full-screen", options->view.full_screen, "fill the screen (F11)");
    command->add_flag(
        "--vsync,!--no-vsync",
        options->view.vsync,
        "one picture a refresh of the display; else as many as there can be");
    command->add_flag(
        "--panels,!--no-panels", options->view.panels, "begin with panels shown (Tab)");
    command
        ->add_option_function<std::string>(
            "--record",
            [options](const std::string& folder) { options->view.record = folder; },
            "record from the first frame into this folder")
        ->type_name("DIR");
    command
        ->add_option_function<std::string>(
            "--records-into",
            [options](const std::string& folder) { options->view.records_into = folder; },
            "where recordings (F9) and screenshots (F12) go")
        ->type_name("DIR")
        ->default_str(".");
    command
        ->add_option(
            "--bench",
            options->bench,
            "time so many frames without a window, with its panels hidden and with panels open, in "
            "turn")
        ->type_name("FRAMES")
        ->check(CLI::Range(1, 100000));
    command->add_flag("--quiet", options->quiet, "no notes");
    add_setting_options(*command, options->view.settings, true);
    command->footer("Examples:\n"
                    "  octant view\n"
                    "  octant view pop-up --aircraft f15 --terrain map.tif --view cockpit\n"
                    "  octant view --by-hand --aircraft 500md --view chase --inset tower\n"
                    "  octant view --settings my-flight/run.json\n"
                    "Of the settings, rate, seconds, pictures, warm-up and realtime count when a "
                    "recording is flown\n"
                    "again by octant fly; --frames closes the window after so many.\n"
                    "No display? octant fly needs none.");
    command->callback([options] {
        options->view.keeps_into = configuration_folder();
        options->view.settings = world::with_absolute_files(options->view.settings);
        if (options->bench > 0) {
            print_bench(window::bench_window(options->view, options->bench, options->quiet));
        } else {
            view(options->view, options->quiet);
        }
    });
}

} // namespace octant::ui::commands
