#include "ui/studies/flicker/study_flicker.h"

#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/report/table_text.h"
#include "ui/studies/flicker/flicker_figures.h"
#include "ui/studies/flicker/flicker_runs.h"
#include "ui/studies/flicker/flicker_tables.h"
#include "ui/studies/flicker/relief_runs.h"
#include "ui/world/terrain_file.h"
#include "visuals/terrain/count_statistics.h"
#include "visuals/terrain/resolution_for_target.h"

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
gain_at(FlickerGround& ground, const terrain::MeshView& view, double weight, double resolution) {
    return terrain::triangle_count_slope(
        ground.mesher, view, {.resolution = resolution, .roughness_weight = weight});
}

void run_fixed(FlickerGround& ground, int frames, FieldRuns& runs, const Tick& tick) {
    const terrain::MeshView view = roughest_view(ground);
    const std::vector views(static_cast<std::size_t>(frames), view);
    for (const double weight : flicker_weights) {
        FlickerSettings settings;
        settings.roughness_weight = weight;
        std::vector<FlickerRun>& of_weight = runs.fixed.emplace_back();
        for (const TriangleControl& triangle_control : triangle_controls()) {
            of_weight.push_back(run_along(triangle_control, ground, settings, views));
            tick();
        }
        runs.fixed_gains.push_back(
            gain_at(ground, view, weight, of_weight[exact_control].resolution.back()) /
            settings.triangles_per_resolution);
    }
}

void run_path(
    FlickerGround& ground,
    std::span<const terrain::MeshView> views,
    FieldRuns& runs,
    const Tick& tick) {
    const FlickerSettings settings;
    for (const TriangleControl& triangle_control : triangle_controls()) {
        runs.path.push_back(
            triangle_control.holds_target ? run_along(triangle_control, ground, settings, views) : FlickerRun());
        tick();
    }
    constexpr std::size_t every = 25;
    for (std::size_t k = 0; k < views.size(); k += every) {
        runs.path_gains.push_back(
            gain_at(
                ground, views[k], settings.roughness_weight, runs.path[exact_control].resolution[k]) /
            settings.triangles_per_resolution);
    }
}

void run_stability(FlickerGround& ground, FieldRuns& runs, const Tick& tick) {
    constexpr std::size_t frames = 60;
    const terrain::MeshView view = roughest_view(ground);
    const std::vector views(frames, view);
    FlickerSettings settings;
    const FlickerRun exact = run_along(triangle_controls()[exact_control], ground, settings, views);
    runs.settling_frames_exact = terrain::frames_until_constant(exact.triangles, 10);
    const double gained =
        gain_at(ground, view, settings.roughness_weight, exact.resolution.back());
    for (const double gain : flicker_gains) {
        settings.triangles_per_resolution = gained / gain;
        auto& of_gain = runs.settling_frames.emplace_back();
        for (const double first : flicker_first) {
            settings.first_resolution = first;
            of_gain.push_back(terrain::frames_until_constant(
                run_along(triangle_controls()[dead_band_control], ground, settings, views).triangles, 10));
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
std::vector<FlickerRun> run_damping_lengths(
    FlickerGround& ground, int frames, const std::vector<FlickerRun>& path, const Tick& tick) {
    const std::vector<terrain::MeshView> views = ellipse_views(ground, frames);
    std::vector<FlickerRun> runs;
    for (const int memory : damping_frame_counts) {
        FlickerSettings settings;
        if (memory == 0) {
            runs.push_back(path[previous_control]);
        } else if (memory == settings.averaged_frames) {
            runs.push_back(path[damped_control]);
        } else {
            settings.averaged_frames = memory;
            runs.push_back(run_along(triangle_controls()[damped_control], ground, settings, views));
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
        const auto few = world::few_samples_note(
            ground->field.name,
            {ground->field.columns(), ground->field.rows()},
            FlickerSettings{}.target_triangles,
            "--gentle and --rugged with larger maps");
        base::print_note(options.quiet || !few, few.value_or(""));
    }
    const int ways = static_cast<int>(triangle_controls().size());
    const int runs_of_field = (static_cast<int>(flicker_weights.size()) + 1) * ways +
                              static_cast<int>(flicker_gains.size() + damping_frame_counts.size());
    const int settling_frames = fixed_frames(options);
    auto gentle_runs = std::async(std::launch::async, [&] {
        return run_field(gentle, gentle.field.name, options.frames, settling_frames, [] {});
    });
    base::Progress progress(rugged.field.name, runs_of_field, options.quiet, "runs");
    int done = 0;
    const Tick tick = [&] { progress.show(++done); };
    FlickerRuns runs;
    runs.rugged = run_field(rugged, rugged.field.name, options.frames, settling_frames, tick);
    runs.damping_lengths = run_damping_lengths(rugged, options.frames, runs.rugged.path, tick);
    progress.finish();
    base::print_note(options.quiet, fmt::format("{}: waiting for its runs", gentle.field.name));
    runs.gentle = gentle_runs.get();
    return runs;
}

std::string changes_csv(const FieldRuns& runs) {
    std::string text = "frame";
    std::vector<const FlickerRun*> shown;
    for (std::size_t triangle_control = 0; triangle_control < runs.path.size(); ++triangle_control) {
        if (!runs.path[triangle_control].triangles.empty()) {
            shown.push_back(&runs.path[triangle_control]);
            text += fmt::format(",\"dn, {}\"", triangle_controls()[triangle_control].name);
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
    base::print_note(options.quiet, "grounds from flats to high mountains");
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
            base::print_note(options.quiet, figure.file + " not made: gnuplot is not installed");
            continue;
        }
        write_file(options.out / figure.file, figure.png);
        with_figures += fmt::format("![{0}]({0})\n\n{1}\n\n", figure.file, figure.caption);
    }
    write_file(options.out / "flicker.md", with_figures);
    std::fputs((options.json ? report::json_of(tables) : markdown).c_str(), stdout);
    base::print_note(
        options.quiet,
        fmt::format(
            "tables and figures: {0}/flicker.md; each table and dn of the paths as .csv, each "
            "figure as .png",
            options.out.string()));
}

} // namespace octant::ui::studies::flicker
