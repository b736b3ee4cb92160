#include "ui/commands/commands.h"
#include "ui/commands/settings_options.h"
#include "ui/settings/read_option.h"
#include "ui/settings/settings_text.h"
#include "ui/studies/draw_order/study_draw_order.h"
#include "ui/studies/draw_order/study_flights.h"
#include "ui/studies/draw_order/study_hidden_surface.h"
#include "ui/studies/flicker/study_flicker.h"
#include "ui/studies/flicker/study_popping.h"
#include "ui/studies/hybrid_shading/study_shading.h"
#include "ui/studies/refinement/study_refinement.h"
#include "ui/studies/simplification/study_simplification.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::commands {

namespace {

void add_out(CLI::App& command, std::filesystem::path& out) {
    command
        .add_option_function<std::string>(
            "--out",
            [&out](const std::string& folder) { out = folder; },
            "folder for the tables (CSV, Markdown) and whatever else comes of it")
        ->type_name("DIR")
        ->required();
}

/// An option that is read like the setting of the same name.
template <class Value>
void add_setting(
    CLI::App& command,
    const std::string& name,
    Value& value,
    const char* form,
    const char* meaning) {
    command
        .add_option_function<std::string>(
            name,
            [name, &value](const std::string& text) {
                settings::read_setting({name, "", "", 16, 8192}, text, value);
            },
            meaning)
        ->type_name(form)
        ->default_str(settings::text_of(value));
}

void add_flights(CLI::App& study) {
    auto options = std::make_shared<studies::draw_order::StudyOptions>();
    CLI::App* flights = study.add_subcommand(
        "flights", "Tables 5 and 6 of the 1989 paper: four paths, two aircraft, three methods");
    add_out(*flights, options->out);
    add_setting(
        *flights,
        "--size",
        options->settings.view.size_px,
        "WIDTHxHEIGHT",
        "picture size in pixels");
    add_setting(
        *flights,
        "--context",
        options->settings.drawing.context,
        "KIND",
        "who draws: osmesa or egl");
    flights->add_flag("--json", options->json, "print the tables as JSON");
    flights->add_flag("--quiet", options->quiet, "no progress, no notes");
    flights->footer("Example:\n  octant study flights --out tables");
    flights->callback([options] { studies::draw_order::study_flights(*options); });
}

void add_draw_order(CLI::App& study) {
    auto options = std::make_shared<studies::draw_order::DrawOrderStudyOptions>();
    CLI::App* orders = study.add_subcommand(
        "draw-order",
        "Tables 1 and 4 of the 1989 paper, and cells, splits, wrong pixels and BSP trees");
    add_out(*orders, options->out);
    orders->add_flag("--json", options->json, "print the tables as JSON");
    orders->add_flag("--quiet", options->quiet, "no progress, no notes");
    orders->footer("Example:\n  octant study draw-order --out tables");
    orders->callback([options] { studies::draw_order::study_draw_order(*options); });
}

void add_flicker(CLI::App& study) {
    auto options = std::make_shared<studies::flicker::FlickerStudyOptions>();
    CLI::App* flicker = study.add_subcommand(
        "flicker",
        "Triangle control of the quadtree paper: its figures 3, 5, 6, 8 and 9, and how quietly "
        "previous, damped and exact control hold the count");
    add_out(*flicker, options->out);
    flicker->add_option("--gentle", options->gentle, "gentle ground: hills, canyon or a file")
        ->type_name("NAME|FILE")
        ->capture_default_str();
    flicker->add_option("--rugged", options->rugged, "rugged ground: hills, canyon or a file")
        ->type_name("NAME|FILE")
        ->capture_default_str();
    add_number_option(
        *flicker,
        {"terrain-spacing", "METRES", "sample spacing of files that do not say", 0.01, 1e5},
        options->spacing_m);
    flicker
        ->add_option(
            "--frames", options->frames, "frames of the path; a fifth of them at a fixed view")
        ->type_name("N")
        ->capture_default_str()
        ->check(CLI::Range(100, 100000));
    flicker->add_flag("--json", options->json, "print the tables as JSON");
    flicker->add_flag("--quiet", options->quiet, "no progress, no notes");
    flicker->footer("Examples:\n  octant study flicker --out tables\n  octant study flicker --out "
                    "tables --gentle pugetsound.tif --rugged gcanyon.tif");
    flicker->callback([options] { studies::flicker::study_flicker(*options); });
}

void add_hidden_surface(CLI::App& study) {
    auto options = std::make_shared<studies::draw_order::HiddenSurfaceStudy>();
    options->settings.path.terrain = "canyon";
    CLI::App* command = study.add_subcommand(
        "hidden-surface",
        "Octant order, depth buffer and removal of back faces: frames a second, and every pixel's "
        "polygon compared");
    add_out(*command, options->out);
    auto only = std::make_shared<std::string>("both");
    command
        ->add_option("--only", *only, "frames a second (race), polygon numbers (pictures) or both")
        ->type_name("PART")
        ->check(CLI::IsMember({"race", "pictures", "both"}))
        ->capture_default_str();
    add_setting(
        *command, "--terrain", options->settings.path.terrain, "NAME|FILE", "ground of both parts");
    add_setting(
        *command,
        "--size",
        options->settings.view.size_px,
        "WIDTHxHEIGHT",
        "picture size of the comparison; the race has 640x480 and 1280x720");
    add_setting(
        *command,
        "--context",
        options->settings.drawing.context,
        "KIND",
        "who draws: osmesa or egl");
    command->add_option("--frames", options->race_frames, "timed frames of each race")
        ->type_name("N")
        ->capture_default_str()
        ->check(CLI::Range(10, 100000));
    command->add_option("--every", options->every, "every Nth frame is compared")
        ->type_name("N")
        ->capture_default_str()
        ->check(CLI::Range(1, 100000));
    command->add_flag("--json", options->json, "print the tables as JSON");
    command->add_flag("--quiet", options->quiet, "no progress, no notes");
    command->footer(
        "Exit code 1 when a pixel is wrong.\n"
        "Example:\n  octant study hidden-surface --out tables --only pictures --every 10");
    command->callback([options, only] {
        options->race = *only != "pictures";
        options->pictures = *only != "race";
        if (!studies::draw_order::study_hidden_surface(*options)) {
            throw CheckSaidNo();
        }
    });
}

void add_popping(CLI::App& study) {
    auto options = std::make_shared<studies::flicker::PoppingStudyOptions>();
    options->settings.path.terrain = "canyon";
    CLI::App* command = study.add_subcommand(
        "popping", "Largest jump of a vertex in any frame of the four paths, and shimmer");
    add_out(*command, options->out);
    settings::Settings& settings = options->settings;
    add_setting(*command, "--terrain", settings.path.terrain, "NAME|FILE", "the ground");
    add_setting(
        *command, "--size", settings.view.size_px, "WIDTHxHEIGHT", "picture size in pixels");
    settings::add_read_option(
        *command, {"triangles", "N", "budget [20000]", 1, 1e8}, settings.ground.triangles);
    settings::add_read_option(
        *command,
        {"error-px", "PIXELS", "screen-error: refined no further [0.25]", 0.001, 1e4},
        settings.ground.error_px);
    settings::add_read_option(
        *command, {"frames", "N", "only the first of each path", 2, 1e7}, settings.time.frames);
    command->add_flag("--shimmer", options->shimmer, "draw, and measure shimmer too");
    command->add_option("--every", options->every, "shimmer: one pair of frames in N")
        ->type_name("N")
        ->capture_default_str()
        ->check(CLI::Range(2, 100000));
    command->add_flag("--json", options->json, "print the tables as JSON");
    command->add_flag("--quiet", options->quiet, "no progress, no notes");
    command->footer("Example:\n  octant study popping --out tables --terrain canyon");
    command->callback([options] { studies::flicker::study_popping(*options); });
}

void add_shading(CLI::App& study) {
    auto options = std::make_shared<studies::hybrid_shading::ShadingStudyOptions>();
    CLI::App* command = study.add_subcommand(
        "shading",
        "Hybrid of flat and Gouraud shading of the 2008 paper: its operation counts, and the "
        "quality of pictures over the share of smooth polygons, by its rule and by ours");
    add_out(*command, options->out);
    command
        ->add_option_function<std::vector<std::string>>(
            "--mesh",
            [options](const std::vector<std::string>& files) {
                options->meshes.assign(files.begin(), files.end());
            },
            "mesh file to look at too, as it is and as it is refined for an eye; may be given more "
            "than once")
        ->type_name("FILE");
    command->add_option("--size", options->size_px, "side of the square pictures in pixels")
        ->type_name("PIXELS")
        ->capture_default_str()
        ->check(CLI::Range(16, 2048));
    command->add_flag("--json", options->json, "print the tables as JSON");
    command->add_flag("--quiet", options->quiet, "no progress, no notes");
    command->add_flag(
        "!--no-times", options->times, "no flights for frame times, which differ from run to run");
    command->footer("Example:\n  octant study shading --out tables --mesh cow.obj");
    command->callback([options] { studies::hybrid_shading::study_shading(*options); });
}

void add_refinement(CLI::App& study) {
    auto options = std::make_shared<studies::refinement::RefinementStudyOptions>();
    CLI::App* command = study.add_subcommand(
        "refinement",
        "Selective refinement: splits forced by three rules, faces turned over, speed, a path");
    add_out(*command, options->out);
    command
        ->add_option("--mesh", options->meshes, "a mesh (repeatable); none: made ground, 129 x 129")
        ->type_name("FILE");
    command->add_option("--base", options->base, "vertices of the base meshes")
        ->type_name("N")
        ->capture_default_str()
        ->check(CLI::Range(4, 1000000));
    command->add_option("--frames", options->frames, "frames of the path")
        ->type_name("N")
        ->capture_default_str()
        ->check(CLI::Range(20, 100000));
    command->add_flag("--json", options->json, "print the tables as JSON");
    command->add_flag("--quiet", options->quiet, "no progress, no notes");
    command->footer("Example:\n  octant study refinement --out tables --mesh bunny.ply --mesh "
                    "cow.obj");
    command->callback([options] { studies::refinement::study_refinement(*options); });
}

void add_simplification(CLI::App& study) {
    auto options = std::make_shared<studies::simplification::SimplificationStudyOptions>();
    CLI::App* command = study.add_subcommand(
        "simplification",
        "Tables 1 and 2 of the 2005 paper on simplification, and every way to simplify, ours and "
        "other libraries', by distance to the original and time");
    add_out(*command, options->out);
    command->add_option("--bunny", options->bunny, "the Stanford bunny, bun_zipper.ply")
        ->type_name("FILE");
    command->add_option("--mesh", options->meshes, "one more mesh; may be repeated")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command
        ->add_option(
            "--faces", options->faces, "simplify to N faces; may be repeated [15, 5, 2.5 %]")
        ->type_name("N")
        ->allow_extra_args(false)
        ->check(CLI::Range(4, 100000000));
    command
        ->add_option(
            "--peers", options->peers, "the program octant-peers [beside this program, if there]")
        ->type_name("PROGRAM");
    command->add_flag("--paper-only", options->paper_only, "tables 1 and 2 only");
    command->add_flag("--json", options->json, "print the tables as JSON");
    command->add_flag("--quiet", options->quiet, "no progress, no notes");
    command->footer("Example:\n  octant study simplification --out tables --bunny bun_zipper.ply");
    command->callback([options] { studies::simplification::study_simplification(*options); });
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
    add_flicker(*study);
    add_hidden_surface(*study);
    add_popping(*study);
    add_shading(*study);
    add_refinement(*study);
    add_simplification(*study);
}

} // namespace octant::ui::commands
