#include "ui/commands.h"
#include "ui/settings_text.h"
#include "ui/study_draw_order.h"
#include "ui/study_flights.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

namespace octant::ui {

namespace {

void add_flights(CLI::App& study) {
    auto options = std::make_shared<StudyOptions>();
    CLI::App* flights = study.add_subcommand(
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

void add_draw_order(CLI::App& study) {
    auto options = std::make_shared<DrawOrderStudyOptions>();
    CLI::App* orders = study.add_subcommand(
        "draw-order",
        "Table 4 of the 1989 paper, and cells, splits, wrong pixels and BSP trees for its models");
    orders
        ->add_option_function<std::string>(
            "--out",
            [options](const std::string& folder) { options->out = folder; },
            "folder for tables (CSV, Markdown)")
        ->type_name("DIR")
        ->required();
    orders->add_flag("--json", options->json, "print the tables as JSON");
    orders->add_flag("--quiet", options->quiet, "no progress, no notes");
    orders->footer("Example:\n  octant study draw-order --out tables");
    orders->callback([options] { study_draw_order(*options); });
}

} // namespace

void add_study_command(CLI::App& program) {
    CLI::App* study = program.add_subcommand(
        "study", "Repeats a paper's experiment and prints its tables with ours beside");
    study->require_subcommand(1);
    study->footer("Examples:\n  octant study flights --out tables\n  octant study draw-order --out "
                  "tables");
    add_flights(*study);
    add_draw_order(*study);
}

} // namespace octant::ui
