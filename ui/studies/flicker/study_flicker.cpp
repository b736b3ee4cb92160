#include "ui/studies/flicker/study_flicker.h"

#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/report/table_text.h"
#include "ui/studies/flicker/flicker_figures.h"
#include "ui/studies/flicker/flicker_runs.h"
#include "ui/studies/flicker/flicker_tables.h"
#include "ui/studies/flicker/relief_runs.h"
#include "ui/world/terrain_file.h"
#include "visuals/terrain/count_series.h"
#include "visuals/terrain/settled_resolution.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <functional>
#include <future>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::studies::flicker {

namespace {

namespace terrain = visuals::terrain;

/// Called after each run.
using Tick = std::function<void()>;

int fixed_frames(const FlickerStudyOptions& options) {
    return std::max(options.frames / 5, 60);
}

/// N'(C) where the exact way settles.
double
gained_at(FlickerGround& ground, const terrain::MeshView& view, double weight, double resolution) {
    return terrain::triangles_gained(
        ground.mesher, view, {.resolution = resolution, .roughness_weight = weight});
}

void run_fixed(FlickerGround& ground, int frames, FieldRuns& runs, const Tick& tick) {
    const terrain::MeshView view = roughest_view(ground);
    const std::vector views(static_cast<std::size_t>(frames), view);
    for (const double weight : flicker_weights) {
        FlickerSettings settings;
        settings.roughness_weight = weight;
        std::vector<FlickerRun>& of_weight = runs.fixed.emplace_back();
        for (const FlickerWay& way : flicker_ways()) {
            of_weight.push_back(run_along(way, ground, settings, views));
            tick();
        }
        runs.fixed_gains.push_back(
            gained_at(ground, view, weight, of_weight[exact_way].resolution.back()) /
            settings.triangles_per_resolution);
    }
}

void run_path(
    FlickerGround& ground,
    std::span<const terrain::MeshView> views,
    FieldRuns& runs,
    const Tick& tick) {
    const FlickerSettings settings;
    for (const FlickerWay& way : flicker_ways()) {
        runs.path.push_back(
            way.holds_target ? run_along(way, ground, settings, views) : FlickerRun());
        tick();
    }
    constexpr std::size_t every = 25;
    for (std::size_t k = 0; k < views.size(); k += every) {
        runs.path_gains.push_back(
            gained_at(
                ground, views[k], settings.roughness_weight, runs.path[exact_way].resolution[k]) /
            settings.triangles_per_resolution);
    }
}

void run_stability(FlickerGround& ground, FieldRuns& runs, const Tick& tick) {
    constexpr std::size_t frames = 60;
    const terrain::MeshView view = roughest_view(ground);
    const std::vector views(frames, view);
    FlickerSettings settings;
    const FlickerRun exact = run_along(flicker_ways()[exact_way], ground, settings, views);
    runs.still_exact = terrain::frames_until_still(exact.triangles, 10);
    const double gained =
        gained_at(ground, view, settings.roughness_weight, exact.resolution.back());
    for (const double gain : flicker_gains) {
        settings.triangles_per_resolution = gained / gain;
        auto& of_gain = runs.still.emplace_back();
        for (const double first : flicker_first) {
            settings.first_resolution = first;
            of_gain.push_back(terrain::frames_until_still(
                run_along(flicker_ways()[settling_way], ground, settings, views).triangles, 10));
        }
        tick();
    }
}

FieldRuns
run_field(FlickerGround& ground, std::string name, int frames, int still_frames, const Tick& tick) {
    FieldRuns runs;
    runs.name = std::move(name);
    run_fixed(ground, still_frames, runs, tick);
    run_path(ground, ellipse_views(ground, frames), runs, tick);
    run_stability(ground, runs, tick);
    return runs;
}

/// Damped as printed along the path, with another r each; two of them were run before.
std::vector<FlickerRun> run_memories(
    FlickerGround& ground, int frames, const std::vector<FlickerRun>& path, const Tick& tick) {
    const std::vector<terrain::MeshView> views = ellipse_views(ground, frames);
    std::vector<FlickerRun> runs;
    for (const int memory : flicker_memories) {
        FlickerSettings settings;
        if (memory == 0) {
            runs.push_back(path[previous_way]);
        } else if (memory == settings.remembered_frames) {
            runs.push_back(path[damped_way]);
        } else {
            settings.remembered_frames = memory;
            runs.push_back(run_along(flicker_ways()[damped_way], ground, settings, views));
        }
        tick();
    }
    return runs;
}

/// Both fields at once, each by a thread of its own.
FlickerRuns run_all(const FlickerStudyOptions& options) {
    FlickerGround gentle(world::load_height_field(options.gentle, options.files));
    FlickerGround rugged(world::load_height_field(options.rugged, options.files));
    for (const FlickerGround* const ground : {&gentle, &rugged}) {
        const auto few = world::note_of_few_samples(
            ground->field.name,
            {ground->field.columns(), ground->field.rows()},
            FlickerSettings{}.target_triangles,
            "--gentle and --rugged with larger maps");
        base::say(options.quiet || !few, few.value_or(""));
    }
    const int ways = static_cast<int>(flicker_ways().size());
    const int runs_of_field = (static_cast<int>(flicker_weights.size()) + 1) * ways +
                              static_cast<int>(flicker_gains.size() + flicker_memories.size());
    const int still = fixed_frames(options);
    auto gentle_runs = std::async(std::launch::async, [&] {
        return run_field(gentle, gentle.field.name, options.frames, still, [] {});
    });
    base::Progress progress(rugged.field.name, runs_of_field, options.quiet, "runs");
    int done = 0;
    const Tick tick = [&] { progress.show(++done); };
    FlickerRuns runs;
    runs.rugged = run_field(rugged, rugged.field.name, options.frames, still, tick);
    runs.memories = run_memories(rugged, options.frames, runs.rugged.path, tick);
    progress.finish();
    base::say(options.quiet, fmt::format("{}: waiting for its runs", gentle.field.name));
    runs.gentle = gentle_runs.get();
    return runs;
}

std::string changes_csv(const FieldRuns& runs) {
    std::string text = "frame";
    std::vector<const FlickerRun*> shown;
    for (std::size_t way = 0; way < runs.path.size(); ++way) {
        if (!runs.path[way].triangles.empty()) {
            shown.push_back(&runs.path[way]);
            text += fmt::format(",\"dn, {}\"", flicker_ways()[way].name);
        }
    }
    text += "\n";
    for (std::size_t k = 1; k < shown.front()->triangles.size(); ++k) {
        text += fmt::format("{}", k);
        for (const FlickerRun* run : shown) {
            text += fmt::format(",{}", run->triangles[k] - run->triangles[k - 1]);
        }
        text += "\n";
    }
    return text;
}

} // namespace

void study_flicker(const FlickerStudyOptions& options) {
    make_folder(options.out);
    const FlickerRuns runs = run_all(options);
    std::string markdown;
    std::vector<report::HtmlTable> tables;
    std::vector<NamedTable> made_tables = flicker_tables(runs);
    base::say(options.quiet, "grounds from flats to high mountains");
    made_tables.push_back({"relief", relief_table(options)});
    for (NamedTable& made : made_tables) {
        write_file(options.out / (made.file + ".csv"), report::csv_of(made.table));
        markdown += report::markdown_of(made.table) + "\n";
        tables.push_back(std::move(made.table));
    }
    write_file(options.out / "path-gentle.csv", changes_csv(runs.gentle));
    write_file(options.out / "path-rugged.csv", changes_csv(runs.rugged));
    std::string with_figures = markdown;
    for (const FlickerFigure& figure : flicker_figures(runs)) {
        if (figure.png.empty()) {
            base::say(options.quiet, figure.file + " not made: gnuplot is not installed");
            continue;
        }
        write_file(options.out / figure.file, figure.png);
        with_figures += fmt::format("![{0}]({0})\n\n{1}\n\n", figure.file, figure.caption);
    }
    write_file(options.out / "flicker.md", with_figures);
    std::fputs((options.json ? report::json_of(tables) : markdown).c_str(), stdout);
    base::say(
        options.quiet,
        fmt::format(
            "tables and figures: {0}/flicker.md; each table and dn of the paths as .csv, each "
            "figure as .png",
            options.out.string()));
}

} // namespace octant::ui::studies::flicker
