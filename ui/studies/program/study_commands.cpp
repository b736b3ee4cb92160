#include "ui/base/output_options.h"
#include "ui/base/version.h"
#include "ui/command_line/manual.h"
#include "ui/command_line/setting_option.h"
#include "ui/studies/draw_order/study_draw_order.h"
#include "ui/studies/draw_order/study_hidden_surface.h"
#include "ui/studies/flicker/study_flicker.h"
#include "ui/studies/flicker/study_popping.h"
#include "ui/studies/hybrid_shading/study_shading.h"
#include "ui/studies/program/bench.h"
#include "ui/studies/program/study_program.h"
#include "ui/studies/refinement/study_refinement.h"
#include "ui/studies/simplification/study_simplification.h"

#include <fmt/format.h>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::studies::program {

using namespace command_line;

namespace {

/// A study's own options between those that every study has.
std::vector<Option> study_options(base::StudyOutput& output, std::vector<Option> own) {
    own.insert(own.begin(), required(text_option("--out", "DIR",
                                "output folder for tables (CSV, Markdown), figures and pictures", output.out)));
    return with_output_options(output, std::move(own));
}

Option size_option(settings::RunSettings& settings, std::string_view meaning) {
    return value_option({"size", "WIDTHxHEIGHT", meaning, 16, 8192}, settings.view.size_px);
}

Option context_option(settings::RunSettings& settings) {
    return value_option({"context", "KIND", "OpenGL context: osmesa or egl"}, settings.drawing.context);
}

Option jobs_option(int& jobs, std::string_view meaning) { return value_option({"jobs", "N", meaning, 1, 1000}, jobs); }

Command flights_command() {
    auto options = std::make_shared<StudyOptions>();
    return {.name = "flights",
        .summary = "Repeats tables 5 and 6 of the 1989 paper: four paths, two aircraft, three hidden-surface methods",
        .options = study_options(
            *options, {size_option(options->settings, "picture size in pixels"), context_option(options->settings),
                          jobs_option(options->jobs,
                              "number of flights run at once; above 1 their frame times affect each other")}),
        .footer = "Example:\n  octant study flights --out tables",
        .run = [options] { studies::draw_order::study_flights(*options); }};
}

Command draw_order_study_command() {
    auto options = std::make_shared<base::StudyOutput>();
    return {.name = "draw-order",
        .summary = "Repeats tables 1 and 4 of the 1989 paper, and compares the ordering methods with each other and "
                   "with a BSP tree",
        .options = study_options(*options, {}),
        .footer = "Example:\n  octant study draw-order --out tables",
        .run = [options] { studies::draw_order::study_draw_order(*options); }};
}

Command flicker_command() {
    auto options = std::make_shared<studies::flicker::FlickerStudyOptions>();
    Command command = {.name = "flicker",
        .summary = "Repeats figures 3, 5, 6, 8 and 9 of the quadtree paper, and compares how steadily its controls, "
                   "the exact triangle budget and the default mesh hold the triangle count",
        .options = study_options(*options,
            {text_option(
                 "--gentle", "NAME|FILE", "terrain with gentle relief: hills, canyon or a file", options->gentle),
                text_option(
                    "--rugged", "NAME|FILE", "terrain with rugged relief: hills, canyon or a file", options->rugged),
                value_option(
                    {"frames", "N", "number of frames along the path; the fixed view has a fifth of them", 100, 100000},
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
                "part to run: race (frames per second), pictures (polygon ids compared with a depth buffer), rays "
                "(polygon ids compared with ray casting) or all",
                {"race", "pictures", "rays", "all"}, only),
        value_option({"terrain", "NAME|FILE", "terrain of all parts"}, study.settings.path.terrain),
        size_option(
            study.settings, "picture size of the comparisons in pixels; the race always uses 640x480 and 1280x720"),
        context_option(study.settings),
        text_option("--aircraft", "NAME|FILE", "aircraft to compare instead of f15 and 500md", study.aircraft),
        jobs_option(study.jobs, "number of views compared at once; the race always runs one flight at a time"),
        value_option({"frames", "N", "number of timed frames of each race", 10, 100000}, study.race_frames),
        value_option({"every", "N", "compare every Nth frame", 1, 100000}, study.every)};
}

Command hidden_surface_command() {
    auto study = std::make_shared<studies::draw_order::HiddenSurfaceStudyOptions>();
    auto only = std::make_shared<std::string>("all");
    study->settings.path.terrain = "canyon";
    Command command = {.name = "hidden-surface",
        .summary = "Compares octant order, depth buffer and back-face removal: frames per second, and the polygon of "
                   "every pixel",
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
        .summary = "Compares the pictures of both renderers with 1, 4 and 16 samples per pixel with a reference of 8 x "
                   "8 samples, still and moving",
        .options = study_options(
            *options, {size_option(options->settings, "picture size in pixels"), context_option(options->settings),
                          value_option({"frames", "N", "number of pictures of each scene", 1, 1000}, options->frames),
                          jobs_option(options->jobs, "number of scenes rendered at once")}),
        .footer = "Example:\n  octant study pictures --out tables",
        .run = [options] { studies::draw_order::study_pictures(*options); }};
}

std::vector<Option> popping_options(studies::flicker::PoppingStudyOptions& options) {
    settings::RunSettings& settings = options.settings;
    return {value_option({"terrain", "NAME|FILE", "terrain"}, settings.path.terrain),
        size_option(settings, "picture size in pixels"),
        value_option({"triangles", "N", "ground triangle budget [20000]", 1, 1e8}, settings.ground.triangles),
        value_option({"error-px", "PIXELS", "screen-error mesh: stop refining at this error [0.25]", 0.001, 1e4},
            settings.ground.error_px),
        value_option({"frames", "N", "use only the first N frames of each path", 2, 1e7}, settings.time.frames),
        jobs_option(options.jobs, "number of flights run at once"),
        flag("--shimmer", "also render pictures and measure shimmer", options.shimmer),
        flag("--near-detail", "also measure a mesh with procedural ground detail near the eye",
            settings.ground.near_detail),
        flag("--scenery", "shimmer: draw procedural trees and houses near the eye", settings.ground.scenery),
        value_option({"every", "N", "shimmer: measure one pair of frames in N", 2, 100000}, options.every)};
}

Command popping_command() {
    auto options = std::make_shared<studies::flicker::PoppingStudyOptions>();
    options->settings.path.terrain = "canyon";
    Command command = {.name = "popping",
        .summary = "Measures the largest vertex jump between frames along the four paths, and shimmer",
        .options = study_options(*options, popping_options(*options)),
        .footer = "Example:\n  octant study popping --out tables --terrain canyon",
        .run = [options] { studies::flicker::study_popping(*options); }};
    add_file_options(command.options, options->settings.path);
    return command;
}

Command shading_command() {
    auto options = std::make_shared<studies::hybrid_shading::ShadingStudyOptions>();
    Command command = {.name = "shading",
        .summary = "Repeats the 2008 paper on hybrid flat and Gouraud shading: operation counts, and picture quality "
                   "as a function of the share of smooth polygons, for its rule and ours",
        .options = study_options(
            *options, {list_option("--mesh", "FILE",
                           "further mesh file, studied as read and as refined for one eye point; repeatable",
                           Arity::OneOrMore, options->meshes),
                          value_option({"size", "PIXELS", "width and height of the pictures in pixels", 16, 2048},
                              options->size_px),
                          jobs_option(options->jobs,
                              "number of models processed at once; flights for frame times always run one at a time")}),
        .footer = "Example:\n  octant study shading --out tables --mesh cow.obj",
        .run = [options] { studies::hybrid_shading::study_shading(*options); }};
    command.options.push_back(flag(
        "!--no-times", "skip the flights that measure frame times (these differ from run to run)", options->times));
    return command;
}

Command refinement_command() {
    auto options = std::make_shared<studies::refinement::RefinementStudyOptions>();
    return {.name = "refinement",
        .summary = "Studies selective refinement: forced splits of three rules, flipped faces, speed, and a path",
        .options = study_options(*options,
            {list_option("--mesh", "FILE", "mesh file; repeatable [a procedural terrain of 129 x 129 samples]",
                 Arity::OneOrMore, options->meshes),
                value_option({"base", "N", "number of vertices of each base mesh", 4, 1000000}, options->base),
                value_option({"frames", "N", "number of frames along the path", 20, 100000}, options->frames)}),
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
    return {text_option("--bunny", "FILE", "file bun_zipper.ply of the Stanford bunny", options.bunny),
        list_option("--mesh", "FILE", "further mesh file; repeatable", Arity::Repeatable, options.meshes),
        {.name = "--faces",
            .form = "N",
            .meaning = "simplify to N faces; repeatable [15, 5 and 2.5 % of each mesh]",
            .arity = Arity::Repeatable,
            .read = [&options](const Words& words) { options.faces = faces_from(words); }},
        text_option("--peers", "PROGRAM",
            "program octant-peers, which runs other libraries [octant-peers in the folder of this program, if present]",
            options.peers),
        flag("--paper-only", "make only tables 1 and 2", options.paper_only)};
}

Command simplification_command() {
    auto options = std::make_shared<studies::simplification::SimplificationStudyOptions>();
    return {.name = "simplification",
        .summary = "Repeats tables 1 and 2 of the 2005 paper on simplification, and compares our methods with other "
                   "libraries by distance to the original and time",
        .options = study_options(*options, simplification_options(*options)),
        .footer = "Example:\n  octant study simplification --out tables --bunny bun_zipper.ply",
        .run = [options] { studies::simplification::study_simplification(*options); }};
}

} // namespace

Program study_program() {
    Program program{.name = "octant-study",
        .about = "Repeats the experiments of the five papers and prints their results next to ours; benchmarks.",
        .version = fmt::format("octant-study {} ({})", base::program_version(), base::program_commit()),
        .footer = "Examples:\n  octant study flights --out tables\n  octant study draw-order --out tables",
        .commands = {flights_command(), draw_order_study_command(), flicker_command(), hidden_surface_command(),
            pictures_command(), popping_command(), shading_command(), refinement_command(), simplification_command(),
            bench_command()}};
    program.commands.push_back(manual_command(program));
    return program;
}

} // namespace octant::ui::studies::program
