#include "ui/base/study_output.h"
#include "ui/commands/commands.h"
#include "ui/commands/terrain_options.h"
#include "ui/commands/value_option.h"
#include "ui/studies/draw_order/study_draw_order.h"
#include "ui/studies/draw_order/study_flights.h"
#include "ui/studies/draw_order/study_hidden_surface.h"
#include "ui/studies/draw_order/study_pictures.h"
#include "ui/studies/flicker/study_flicker.h"
#include "ui/studies/flicker/study_popping.h"
#include "ui/studies/hybrid_shading/study_shading.h"
#include "ui/studies/refinement/study_refinement.h"
#include "ui/studies/simplification/study_simplification.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::commands {

namespace {

/// A study's own options between those that every study has.
std::vector<Option> study_options(base::StudyOutput& output, std::vector<Option> own) {
    own.insert(own.begin(), required(text_option("--out", "DIR",
                                "folder for the tables (CSV, Markdown) and whatever else comes of it", output.out)));
    own.push_back(flag("--json", "print the tables as JSON", output.json));
    own.push_back(flag("--quiet", "no progress, no notes", output.quiet));
    return own;
}

Option size_option(settings::RunSettings& settings, std::string_view meaning) {
    return value_option({"size", "WIDTHxHEIGHT", meaning, 16, 8192}, settings.view.size_px);
}

Option context_option(settings::RunSettings& settings) {
    return value_option({"context", "KIND", "who draws: osmesa or egl"}, settings.drawing.context);
}

Option jobs_option(int& jobs, std::string_view meaning) { return value_option({"jobs", "N", meaning, 1, 1000}, jobs); }

Command flights_command() {
    auto options = std::make_shared<studies::draw_order::FlightStudyOptions>();
    return {.name = "flights",
        .summary = "Tables 5 and 6 of the 1989 paper: four paths, two aircraft, three methods",
        .options = study_options(
            *options, {size_option(options->settings, "picture size in pixels"), context_option(options->settings),
                          jobs_option(options->jobs, "flights at once; their times then depend on each other")}),
        .footer = "Example:\n  octant study flights --out tables",
        .run = [options] { studies::draw_order::study_flights(*options); }};
}

Command draw_order_study_command() {
    auto options = std::make_shared<studies::draw_order::DrawOrderStudyOptions>();
    return {.name = "draw-order",
        .summary = "Tables 1 and 4 of the 1989 paper, and cells, splits, wrong pixels and BSP trees",
        .options = study_options(*options, {}),
        .footer = "Example:\n  octant study draw-order --out tables",
        .run = [options] { studies::draw_order::study_draw_order(*options); }};
}

Command flicker_command() {
    auto options = std::make_shared<studies::flicker::FlickerStudyOptions>();
    Command command = {.name = "flicker",
        .summary = "Triangle control of the quadtree paper: its figures 3, 5, 6, 8 and 9, and how "
                   "quietly previous, damped and exact control hold the count",
        .options = study_options(*options,
            {text_option("--gentle", "NAME|FILE", "gentle ground: hills, canyon or a file", options->gentle),
                text_option("--rugged", "NAME|FILE", "rugged ground: hills, canyon or a file", options->rugged),
                value_option({"frames", "N", "frames of the path; a fifth of them at a fixed view", 100, 100000},
                    options->frames)}),
        .footer = "Examples:\n  octant study flicker --out tables\n  octant study flicker --out "
                  "tables --gentle pugetsound.tif --rugged gcanyon.tif",
        .run = [options] { studies::flicker::study_flicker(*options); }};
    add_file_options(command.options, options->files);
    return command;
}

void hidden_surface(studies::draw_order::HiddenSurfaceStudyOptions study, const std::string& only) {
    const auto wants = [&](std::string_view part) { return only == part || only == "all"; };
    study.race = wants("race");
    study.pictures = wants("pictures");
    study.rays = wants("rays");
    if (!studies::draw_order::study_hidden_surface(study)) { throw CheckFailed(); }
}

std::vector<Option> hidden_surface_options(studies::draw_order::HiddenSurfaceStudyOptions& study, std::string& only) {
    return {choice_option("--only", "PART",
                "frames a second (race), polygon numbers against a depth buffer (pictures), against "
                "rays (rays) or all",
                {"race", "pictures", "rays", "all"}, only),
        value_option({"terrain", "NAME|FILE", "ground of all parts"}, study.settings.path.terrain),
        size_option(study.settings, "picture size of the comparison; the race has 640x480 and 1280x720"),
        context_option(study.settings),
        text_option("--aircraft", "NAME|FILE", "compare this one in place of f15 and 500md", study.aircraft),
        jobs_option(study.jobs, "views of a flight compared at once; the race is one at a time"),
        value_option({"frames", "N", "timed frames of each race", 10, 100000}, study.race_frames),
        value_option({"every", "N", "every Nth frame is compared", 1, 100000}, study.every)};
}

Command hidden_surface_command() {
    auto study = std::make_shared<studies::draw_order::HiddenSurfaceStudyOptions>();
    auto only = std::make_shared<std::string>("all");
    study->settings.path.terrain = "canyon";
    Command command = {.name = "hidden-surface",
        .summary = "Octant order, depth buffer and removal of back faces: frames a second, and "
                   "every pixel's polygon compared",
        .options = study_options(*study, hidden_surface_options(*study, *only)),
        .footer = "Exit code 1 when a pixel is wrong.\n"
                  "Examples:\n  octant study hidden-surface --out tables --only pictures --every 10\n"
                  "  octant study hidden-surface --out tables --only rays --every 14 --size 480x270",
        .run = [study, only] { hidden_surface(*study, *only); }};
    add_file_options(command.options, study->settings.path);
    return command;
}

Command pictures_command() {
    auto options = std::make_shared<studies::draw_order::PictureStudyOptions>();
    return {.name = "pictures",
        .summary = "How near the pictures of both renderers, with 1, 4 and 16 samples a pixel, "
                   "come to 8 x 8 samples, standing and moving",
        .options = study_options(
            *options, {size_option(options->settings, "picture size in pixels"), context_option(options->settings),
                          value_option({"frames", "N", "pictures of each scene", 1, 1000}, options->frames),
                          jobs_option(options->jobs, "scenes at once")}),
        .footer = "Example:\n  octant study pictures --out tables",
        .run = [options] { studies::draw_order::study_pictures(*options); }};
}

std::vector<Option> popping_options(studies::flicker::PoppingStudyOptions& options) {
    settings::RunSettings& settings = options.settings;
    return {value_option({"terrain", "NAME|FILE", "the ground"}, settings.path.terrain),
        size_option(settings, "picture size in pixels"),
        value_option({"triangles", "N", "budget [20000]", 1, 1e8}, settings.ground.triangles),
        value_option(
            {"error-px", "PIXELS", "screen-error: refined no further [0.25]", 0.001, 1e4}, settings.ground.error_px),
        value_option({"frames", "N", "only the first of each path", 2, 1e7}, settings.time.frames),
        jobs_option(options.jobs, "flights at once"),
        flag("--shimmer", "draw, and measure shimmer too", options.shimmer),
        flag("--near-detail", "also with made-up detail of the ground near the eye", settings.ground.near_detail),
        flag("--scenery", "shimmer: with made-up trees and houses near the eye", settings.ground.scenery),
        value_option({"every", "N", "shimmer: one pair of frames in N", 2, 100000}, options.every)};
}

Command popping_command() {
    auto options = std::make_shared<studies::flicker::PoppingStudyOptions>();
    options->settings.path.terrain = "canyon";
    Command command = {.name = "popping",
        .summary = "Largest jump of a vertex in any frame of the four paths, and shimmer",
        .options = study_options(*options, popping_options(*options)),
        .footer = "Example:\n  octant study popping --out tables --terrain canyon",
        .run = [options] { studies::flicker::study_popping(*options); }};
    add_file_options(command.options, options->settings.path);
    return command;
}

Command shading_command() {
    auto options = std::make_shared<studies::hybrid_shading::ShadingStudyOptions>();
    Command command = {.name = "shading",
        .summary = "Hybrid of flat and Gouraud shading of the 2008 paper: its operation counts, "
                   "and the quality of pictures over the share of smooth polygons, by its rule and "
                   "by ours",
        .options = study_options(*options,
            {list_option("--mesh", "FILE",
                 "mesh file to look at too, as it is and as it is refined for an eye; may be given "
                 "more than once",
                 Arity::OneOrMore, options->meshes),
                value_option({"size", "PIXELS", "side of the square pictures in pixels", 16, 2048}, options->size_px),
                jobs_option(options->jobs, "models at once; flights for times are one at a time")}),
        .footer = "Example:\n  octant study shading --out tables --mesh cow.obj",
        .run = [options] { studies::hybrid_shading::study_shading(*options); }};
    command.options.push_back(
        flag("!--no-times", "no flights for frame times, which differ from run to run", options->times));
    return command;
}

Command refinement_command() {
    auto options = std::make_shared<studies::refinement::RefinementStudyOptions>();
    return {.name = "refinement",
        .summary = "Selective refinement: splits forced by three rules, faces turned over, speed, a path",
        .options = study_options(
            *options, {list_option("--mesh", "FILE", "a mesh (repeatable); none: made ground, 129 x 129",
                           Arity::OneOrMore, options->meshes),
                          value_option({"base", "N", "vertices of the base meshes", 4, 1000000}, options->base),
                          value_option({"frames", "N", "frames of the path", 20, 100000}, options->frames)}),
        .footer = "Example:\n  octant study refinement --out tables --mesh bunny.ply --mesh "
                  "cow.obj",
        .run = [options] { studies::refinement::study_refinement(*options); }};
}

/// Numbers of faces from the words of all --faces. Throws Error.
std::vector<std::size_t> faces_from(const Words& words) {
    std::vector<std::size_t> faces;
    for (const std::string& word : words) {
        int number = 0;
        settings::read_setting({"--faces", "N", "", 4, 100000000}, word, number);
        faces.push_back(static_cast<std::size_t>(number));
    }
    return faces;
}

std::vector<Option> simplification_options(studies::simplification::SimplificationStudyOptions& options) {
    return {text_option("--bunny", "FILE", "the Stanford bunny, bun_zipper.ply", options.bunny),
        list_option("--mesh", "FILE", "one more mesh; may be repeated", Arity::Repeatable, options.meshes),
        {.name = "--faces",
            .form = "N",
            .meaning = "simplify to N faces; may be repeated [15, 5, 2.5 %]",
            .arity = Arity::Repeatable,
            .read = [&options](const Words& words) { options.faces = faces_from(words); }},
        text_option("--peers", "PROGRAM", "the program octant-peers [beside this program, if there]", options.peers),
        flag("--paper-only", "tables 1 and 2 only", options.paper_only)};
}

Command simplification_command() {
    auto options = std::make_shared<studies::simplification::SimplificationStudyOptions>();
    return {.name = "simplification",
        .summary = "Tables 1 and 2 of the 2005 paper on simplification, and every way to simplify, "
                   "ours and other libraries', by distance to the original and time",
        .options = study_options(*options, simplification_options(*options)),
        .footer = "Example:\n  octant study simplification --out tables --bunny bun_zipper.ply",
        .run = [options] { studies::simplification::study_simplification(*options); }};
}

} // namespace

Command study_command() {
    return {.name = "study",
        .summary = "Repeats a paper's experiment and prints its tables with ours beside",
        .footer = "Examples:\n  octant study flights --out tables\n  octant study draw-order --out "
                  "tables",
        .commands = {flights_command(), draw_order_study_command(), flicker_command(), hidden_surface_command(),
            pictures_command(), popping_command(), shading_command(), refinement_command(), simplification_command()}};
}

} // namespace octant::ui::commands
