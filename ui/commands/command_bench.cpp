#include "ui/base/results_text.h"
#include "ui/commands/bench.h"
#include "ui/commands/commands.h"
#include "ui/commands/terrain_options.h"
#include "ui/commands/value_option.h"

#include <array>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <optional>
#include <string>

namespace octant::ui::commands {

namespace {

struct BenchCommand {
    BenchOptions options;
    bool formation = false;
    bool json = false;
};

/// A scene that is harder than the usual ones: ten aircraft in a picture of two million pixels.
void set_formation(BenchOptions& options) {
    constexpr std::size_t aircraft = 10;
    options.terrains = {"canyon"};
    options.settings.path.aircraft.assign(aircraft, "f15");
    options.settings.view.size_px = {1920, 1080};
    options.settings.ground.triangles = 25000;
}

std::string figure_or_dash(const std::optional<double>& value, int decimals) {
    return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

void print_table(const std::vector<BenchResult>& results) {
    std::fputs(fmt::format("{:<59} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8} {:>10} {:>10} {:>8} {:>8} {:>9} "
                           "{:>8}  {}\n",
                   "scene", "median ms", "p99 ms", "ratio", "sim ms", "plan ms", "draw ms", "read ms", "mesh wait",
                   "draw wait", "CPU ms", "of plain", "triangles", "ms/1000", "hash")
                   .c_str(),
        stdout);
    for (const BenchResult& r : results) {
        std::fputs(fmt::format("{:<59} {:>9.2f} {:>9.2f} {:>8.2f} {:>8.3f} {:>8.2f} {:>8.2f} {:>8.2f} {:>10.2f} "
                               "{:>10.2f} {:>8.2f} {:>8} {:>9} {:>8}  {:016x}\n",
                       r.name, r.median_ms, r.p99_ms, r.ratio, r.sim_ms, r.plan_ms, r.draw_ms, r.read_ms,
                       r.mesh_wait_ms, r.draw_wait_ms, r.cpu_ms, figure_or_dash(r.ratio_to_plain, 2), r.triangles,
                       figure_or_dash(r.ms_per_1000_triangles, 3), r.hash)
                       .c_str(),
            stdout);
    }
}

void print_json(const std::vector<BenchResult>& results) {
    auto scenes = base::JsonValue::list({});
    for (const BenchResult& r : results) {
        scenes.push_back({{"name", r.name}, {"median_ms", r.median_ms}, {"p99_ms", r.p99_ms}, {"ratio", r.ratio},
            {"sim_ms", r.sim_ms}, {"plan_ms", r.plan_ms}, {"draw_ms", r.draw_ms}, {"read_ms", r.read_ms},
            {"mesh_wait_ms", r.mesh_wait_ms}, {"draw_wait_ms", r.draw_wait_ms}, {"cpu_ms", r.cpu_ms},
            {"of_plain", r.ratio_to_plain}, {"triangles", r.triangles},
            {"ms_per_1000_triangles", r.ms_per_1000_triangles}, {"hash", fmt::format("{:016x}", r.hash)}});
    }
    base::print_value({{"scenes", scenes}}, true);
}

constexpr std::array sample_counts{1, 4, 16};

/// An option for one thing each time that it stands, with all defaults in help.
Option repeat_option(std::string name, std::string meaning, std::vector<std::string>& values) {
    return with_shown_default(fmt::format("[{}]", fmt::join(values, ",")),
        list_option(std::move(name), "NAME|FILE", std::move(meaning), Arity::Repeatable, values));
}

std::vector<Option> options_of(BenchCommand& bench) {
    BenchOptions& options = bench.options;
    settings::RunSettings& settings = options.settings;
    std::vector<Option> table = {
        with_shown_default("[hills,canyon,background60; with --features: hills]",
            list_option("--terrain", "NAME|FILE", "scenes: one for each ground", Arity::Repeatable, options.terrains)),
        repeat_option("--aircraft", "aircraft of every scene; repeat for wingmen", settings.path.aircraft),
        value_option({"size", "WIDTHxHEIGHT", "picture size in pixels", 16, 8192}, settings.view.size_px),
        with_shown_default(
            "20000", value_option({"triangles", "N", "triangles of ground", 100, 10000000}, settings.ground.triangles)),
        value_option({"renderer", "KIND", "raster or gl; auto: both in turn, with --features raster"},
            settings.drawing.renderer),
        value_option(
            {"samples", "N", "samples a pixel [raster: 16, gl: 1]", 1, 16, sample_counts}, settings.view.samples),
        value_option({"context", "KIND", "OpenGL's context: osmesa or egl"}, settings.drawing.context),
        value_option({"frames", "N", "timed frames of each scene [300; with --features 30, about a minute]", 1, 100000},
            options.frames),
        flag("--formation", "ten F-15s over the canyon, 25,000 triangles, 1920x1080, in place of other scenes",
            bench.formation),
        flag("--near-detail", "with made-up detail of the ground near the eye", settings.ground.near_detail),
        flag("--scenery", "with made-up trees and houses near the eye", settings.ground.scenery),
        flag("--features",
            "a table of costs: each scene without features, with each one alone (near detail, "
            "scenery, sky, ...), with an airfield, with the defaults and with all, frame by frame "
            "in turn",
            options.features),
        flag("--growth",
            "each scene with 20,000, 50,000, 100,000 and 200,000 triangles of ground in turn, in "
            "place of --triangles; ms/1000 is the median for each 1,000 triangles",
            options.triangle_counts),
        flag("--json", "as JSON", bench.json), flag("--quiet", "no progress", options.quiet)};
    add_file_options(table, settings.path);
    return table;
}

} // namespace

Command bench_command() {
    auto bench = std::make_shared<BenchCommand>();
    return {.name = "bench",
        .summary = "Frame times of standard scenes in turn with the platform's floor, each as a "
                   "ratio to it",
        .options = options_of(*bench),
        .footer = "Example:\n  octant bench --terrain map.tif --size 1920x1080 --json\n"
                  "  octant bench --features --terrain hills --aircraft 500md --renderer raster\n"
                  "  octant bench --growth --terrain canyon",
        .run = [bench] {
            if (bench->formation) { set_formation(bench->options); }
            const std::vector<BenchResult> results = run_bench(bench->options);
            bench->json ? print_json(results) : print_table(results);
        }};
}

} // namespace octant::ui::commands
