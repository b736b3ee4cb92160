#include "ui/window/command_view.h"

#include "sim/base/error.h"
#include "ui/input_files.h"
#include "ui/progress.h"
#include "ui/settings_options.h"
#include "ui/window/viewer.h"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

namespace octant::ui {

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

void view(ViewOptions options, bool quiet) {
    options.settings = with_absolute_files(options.settings);
    Viewer viewer(options);
    for (const std::string& note : viewer.session().world().notes) {
        say(quiet, "note: " + note);
    }
    int frames = 0;
    while (viewer.turn()) {
        if (options.settings.frames && ++frames >= *options.settings.frames) {
            break;
        }
    }
    if (const auto report = viewer.finish_recording()) {
        say(quiet, *report);
    }
}

} // namespace

void add_view_command(CLI::App& program) {
    struct Options {
        ViewOptions view;
        bool quiet = false;
    };

    auto options = std::make_shared<Options>();
    options->view.settings.terrain = "canyon";
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
    command->add_flag("--quiet", options->quiet, "no notes");
    add_setting_options(*command, options->view.settings, true);
    command->footer("Examples:\n"
                    "  octant view\n"
                    "  octant view pop-up --aircraft f15 --terrain map.tif --view cockpit\n"
                    "  octant view --by-hand --aircraft 500md --view chase --inset tower\n"
                    "  octant view --settings my-flight/run.json\n"
                    "No display? octant fly needs none.");
    command->callback([options] {
        options->view.keeps_into = configuration_folder();
        view(options->view, options->quiet);
    });
}

} // namespace octant::ui
