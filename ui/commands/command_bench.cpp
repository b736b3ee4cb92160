#include "ui/base/figures_text.h"
#include "ui/commands/bench.h"
#include "ui/commands/commands.h"
#include "ui/settings/settings_text.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

namespace octant::ui::commands {

namespace {

struct BenchCommand {
    BenchOptions options;
    bool json = false;
};

void print_table(const std::vector<BenchResult>& results) {
    std::fputs(
        fmt::format(
            "{:<42} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9}  {}\n",
            "scene",
            "median ms",
            "p99 ms",
            "ratio",
            "sim ms",
            "plan ms",
            "draw ms",
            "read ms",
            "triangles",
            "hash")
            .c_str(),
        stdout);
    for (const BenchResult& r : results) {
        std::fputs(
            fmt::format(
                "{:<42} {:>9.2f} {:>9.2f} {:>8.2f} {:>8.3f} {:>8.2f} {:>8.2f} {:>8.2f} {:>9}  "
                "{:016x}\n",
                r.name,
                r.median_ms,
                r.p99_ms,
                r.ratio,
                r.sim_ms,
                r.plan_ms,
                r.draw_ms,
                r.read_ms,
                r.triangles,
                r.hash)
                .c_str(),
            stdout);
    }
}

void print_json(const std::vector<BenchResult>& results) {
    nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
    for (const BenchResult& r : results) {
        scenes.push_back(
            {{"name", r.name},
             {"median_ms", r.median_ms},
             {"p99_ms", r.p99_ms},
             {"ratio", r.ratio},
             {"sim_ms", r.sim_ms},
             {"plan_ms", r.plan_ms},
             {"draw_ms", r.draw_ms},
             {"read_ms", r.read_ms},
             {"triangles", r.triangles},
             {"hash", fmt::format("{:016x}", r.hash)}});
    }
    base::print_figures(nlohmann::ordered_json{{"scenes", scenes}}, true);
}

} // namespace

void add_bench_command(CLI::App& program) {
    auto bench = std::make_shared<BenchCommand>();
    bench->options.terrains = {"hills", "canyon", "background60"};
    BenchOptions& options = bench->options;
    CLI::App* command = program.add_subcommand(
        "bench",
        "Frame times of standard scenes in turn with the platform's floor, each as a ratio to it");
    command->add_option("--terrain", options.terrains, "scenes: one for each ground")
        ->type_name("NAME|FILE")
        ->capture_default_str()
        ->allow_extra_args(false);
    command
        ->add_option(
            "--aircraft",
            options.settings.path.aircraft,
            "aircraft of every scene; repeat for wingmen")
        ->type_name("NAME|FILE")
        ->capture_default_str()
        ->allow_extra_args(false);
    command
        ->add_option_function<std::string>(
            "--size",
            [bench](const std::string& text) {
                settings::read_setting(
                    {"--size", "", "", 16, 8192}, text, bench->options.settings.view.size_px);
            },
            "picture size in pixels")
        ->type_name("WIDTHxHEIGHT")
        ->default_str(settings::text_of(options.settings.view.size_px));
    command->add_option("--triangles", options.settings.ground.triangles, "triangles of ground")
        ->type_name("N")
        ->default_str("20000")
        ->check(CLI::Range(100, 10000000));
    command
        ->add_option_function<std::string>(
            "--context",
            [bench](const std::string& text) {
                settings::read_setting(
                    {"--context", "", ""}, text, bench->options.settings.drawing.context);
            },
            "who draws: osmesa or egl")
        ->type_name("KIND")
        ->default_str(settings::text_of(options.settings.drawing.context));
    command->add_option("--frames", options.frames, "timed frames of each scene")
        ->type_name("N")
        ->capture_default_str()
        ->check(CLI::Range(1, 100000));
    command->add_flag("--json", bench->json, "as JSON");
    command->add_flag("--quiet", options.quiet, "no progress");
    command->footer("Example:\n  octant bench --terrain map.tif --size 1920x1080 --json");
    command->callback([bench] {
        const std::vector<BenchResult> results = run_bench(bench->options);
        bench->json ? print_json(results) : print_table(results);
    });
}

} // namespace octant::ui::commands
