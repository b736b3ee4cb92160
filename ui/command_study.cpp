#include "ui/commands.h"
#include "ui/settings_text.h"
#include "ui/study_flights.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

namespace octant::ui {

void add_study_command(CLI::App& program) {
    CLI::App* study = program.add_subcommand(
        "study", "Repeats a paper's experiment and prints its tables with ours beside");
    study->require_subcommand(1);
    study->footer("Example:\n  octant study flights --out tables");
    auto options = std::make_shared<StudyOptions>();
    CLI::App* flights = study->add_subcommand(
        "flights", "Tables 5 and 6 of the 1989 paper: four paths, two aircraft, three methods");
    flights
        ->add_option_function<std::string>(
            "--out",
            [options](const std::string& folder) { options->out = folder; },
            "folder for tables (CSV, Markdown), plot, recordings and report")
        ->type_name("DIR")
        ->required();
    flights
        ->add_option_function<std::string>(
            "--size",
            [options](const std::string& text) {
                read_setting({"--size", "", "", 16, 8192}, text, options->settings.size_px);
            },
            "picture size in pixels")
        ->type_name("WIDTHxHEIGHT")
        ->default_str(text_of(options->settings.size_px));
    flights
        ->add_option_function<std::string>(
            "--context",
            [options](const std::string& text) {
                read_setting({"--context", "", ""}, text, options->settings.context);
            },
            "who draws: osmesa or egl")
        ->type_name("KIND")
        ->default_str(text_of(options->settings.context));
    flights->add_flag("--json", options->json, "print the tables as JSON");
    flights->add_flag("--quiet", options->quiet, "no progress, no notes");
    flights->footer("Example:\n  octant study flights --out tables");
    flights->callback([options] { study_flights(*options); });
}

} // namespace octant::ui
