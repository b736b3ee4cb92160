#include "ui/studies/hybrid_shading/study_shading.h"

#include "sim/base/output_file.h"
#include "sim/base/parallel_for.h"
#include "ui/base/progress.h"
#include "ui/report/plots.h"
#include "ui/report/png_file.h"
#include "ui/report/table_text.h"
#include "ui/studies/hybrid_shading/budget_times.h"
#include "ui/studies/hybrid_shading/shading_models.h"
#include "ui/studies/hybrid_shading/shading_runs.h"
#include "ui/studies/hybrid_shading/shading_tables.h"
#include "ui/studies/hybrid_shading/shading_times.h"
#include "ui/studies/shading_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::studies::hybrid_shading {

namespace {

constexpr double strip_share = 0.2;
constexpr float shown_as_white = 2.4F; ///< light of the pictures; errors are shown eightfold
constexpr float error_scale = 8.0F;
constexpr std::byte background{40};

/// Name in file names.
std::string file_part(std::string name) {
    std::ranges::replace(name, ' ', '-');
    return name;
}

std::byte grey_of(float light) {
    const float part = std::clamp(light / shown_as_white, 0.0F, 1.0F);
    return static_cast<std::byte>(std::lround(255.0F * part));
}

/// Pictures side by side, below them their differences from the last but one.
report::Picture
column_rect(const std::vector<LightPicture>& row, const std::vector<std::uint8_t>& on) {
    const auto size = static_cast<std::size_t>(row.front().size_px);
    const LightPicture& reference = row[row.size() - 2];
    report::Picture strip;
    strip.width_px = static_cast<int>(size * row.size());
    strip.height_px = static_cast<int>(2 * size);
    strip.bytes.assign(std::size_t{6} * size * size * row.size(), background);
    for (std::size_t k = 0; k < row.size(); ++k) {
        for (std::size_t at = 0; at < size * size; ++at) {
            if (on[at] == 0) {
                continue;
            }
            const float light = row[k].light[at];
            const float error = error_scale * std::abs(light - reference.light[at]);
            const std::size_t column = k * size + at % size;
            const std::size_t above = at / size * size * row.size() + column;
            const std::size_t below = above + size * size * row.size();
            std::fill_n(
                strip.bytes.begin() + static_cast<std::ptrdiff_t>(3 * above), 3, grey_of(light));
            std::fill_n(
                strip.bytes.begin() + static_cast<std::ptrdiff_t>(3 * below), 3, grey_of(error));
        }
    }
    return strip;
}

report::Picture column_rect(const ShadedModel& model, int size_px) {
    const glm::dvec3 eye_m = study_eyes(model.polygons).front();
    const ShadingPictures pictures(model.polygons, study_light(), eye_m, size_px);
    std::vector<LightPicture> row;
    row.push_back(pictures.hybrid(std::vector<std::uint8_t>(model.polygons.size(), 0)));
    for (const StudiedRule& rule : studied_rules) {
        row.push_back(pictures.hybrid(smooth_polygons(model.polygons, rule, eye_m, strip_share)));
    }
    row.push_back(pictures.hybrid(std::vector<std::uint8_t>(model.polygons.size(), 1)));
    row.push_back(pictures.per_pixel());
    return column_rect(row, pictures.covered());
}

report::Plot curve_plot(const ShadingRun& run) {
    constexpr std::array colours{"#888888", "#d62728", "#ff9f40", "#1f77b4"};
    report::Plot plot;
    plot.title = fmt::format("{}, {} polygons", run.name, run.polygons);
    plot.x_label = "smooth polygons, %";
    plot.y_label = "PSNR, dB";
    for (std::size_t rule = 0; rule < studied_rules.size(); ++rule) {
        report::PlotSeries series;
        series.name = studied_rules[rule].name;
        series.colour = colours[rule];
        for (std::size_t step = 0; step < share_steps; ++step) {
            series.x.push_back(static_cast<double>(step * share_step_percent));
            const double db = run.rules[rule].to_gouraud[step].psnr_db();
            series.y.push_back(db < exact_db ? db : std::numeric_limits<double>::infinity());
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

/// Curves and strips; the Markdown that shows them.
std::string write_figures(
    const ShadingStudyOptions& options,
    const std::vector<ShadedModel>& models,
    const std::vector<ShadingRun>& runs) {
    std::string markdown;
    std::vector<report::Plot> plots;
    plots.reserve(runs.size());
    for (const ShadingRun& run : runs) {
        plots.push_back(curve_plot(run));
    }
    if (const auto png = report::plots_png(plots)) {
        write_file(options.out / "curves.png", *png);
        markdown +=
            "![curves.png](curves.png)\n\nPSNR against all Gouraud; a curve ends where it is "
            "exact.\n\n";
    } else {
        base::print_note(options.quiet, "curves.png not made: gnuplot is not installed");
    }
    for (const ShadedModel& model : models) {
        const std::string file = "strip-" + file_part(model.name) + ".png";
        report::write_png(options.out / file, column_rect(model, options.size_px).view());
        markdown += fmt::format(
            "![{0}]({0})\n\n{1}: all flat; {2:.0f} % smooth at random, by the paper's rule, by the "
            "same among polygons that face the eye, by the error; all Gouraud; each pixel. Below: "
            "difference from all Gouraud, {3:.0f} "
            "times.\n\n",
            file,
            model.name,
            100.0 * strip_share,
            error_scale);
    }
    return markdown;
}

} // namespace

void study_shading(const ShadingStudyOptions& options) {
    const std::vector<ShadedModel> models = shading_models(options.meshes);
    make_folder(options.out);
    std::vector<ShadingRun> runs(models.size());
    const bool quiet = options.quiet || options.jobs > 1; // progress of one at a time only
    parallel_for(models.size(), options.jobs, [&](std::size_t i, std::size_t /*worker*/) {
        const ShadedModel& model = models[i];
        const int eyes = static_cast<int>(study_eyes(model.polygons).size());
        base::Progress progress(model.name, eyes, quiet, "views");
        int done = 0;
        runs[i] = run_shading(model, options.size_px, [&] { progress.show(++done); });
        progress.finish();
    });
    std::vector<report::HtmlTable> tables{
        operation_table(), gain_table(runs), control_table(control_runs())};
    std::vector<std::string> files{"operations", "gain", "control"};
    for (const ShadingRun& run : runs) {
        tables.push_back(quality_table(run));
        files.push_back("quality-" + file_part(run.name));
    }
    if (options.times) {
        std::vector<std::string> aircraft{"f15", "500md"};
        for (const std::filesystem::path& mesh : options.meshes) {
            aircraft.push_back(mesh.string());
        }
        tables.push_back(shading_times_table(aircraft, options.quiet));
        files.emplace_back("times");
        tables.push_back(budget_times_table(aircraft, options.quiet));
        files.emplace_back("held");
    }
    std::string markdown;
    for (std::size_t i = 0; i < tables.size(); ++i) {
        write_file(options.out / (files[i] + ".csv"), report::csv_of(tables[i]));
        markdown += report::markdown_of(tables[i]) + "\n";
    }
    write_file(options.out / "shading.md", markdown + write_figures(options, models, runs));
    std::fputs((options.json ? report::json_of(tables) : markdown).c_str(), stdout);
    base::print_note(
        options.quiet,
        fmt::format(
            "tables and figures: {0}/shading.md; each table as .csv, each figure as .png",
            options.out.string()));
}

} // namespace octant::ui::studies::hybrid_shading
