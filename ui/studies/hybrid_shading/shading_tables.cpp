#include "ui/studies/hybrid_shading/shading_tables.h"

#include "ui/studies/picture_quality.h"
#include "visuals/shading/operation_counts.h"
#include "visuals/shading/smooth_count.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace octant::ui::studies::hybrid_shading {

namespace shading = visuals::shading;

namespace {

constexpr int printed_polygons = 415;
constexpr double printed_device_ratio = 0.028;

std::string decibels(double db) {
    return db < exact_db ? fmt::format("{:.2f}", db) : "exact";
}

std::string gain_text(double ours_db, double gain_db) {
    return ours_db < exact_db ? fmt::format("{:.2f}", gain_db) : "exact";
}

/// Smallest gain of any view; infinite where each is exact.
double min_gain_db(const ShareQuality& ours, const ShareQuality& theirs) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t view = 0; view < ours.mean_square.size(); ++view) {
        if (ours.mean_square[view] > 0.0) {
            least = std::min(
                least, psnr_db(ours.mean_square[view]) - psnr_db(theirs.mean_square[view]));
        }
    }
    return least;
}

} // namespace

report::HtmlTable operation_table() {
    const int smooth = shading::device_smooth_count(printed_device_ratio, printed_polygons);
    const auto counts = shading::operation_counts(printed_polygons, smooth);
    const auto whole = shading::operation_counts(printed_polygons + 1, smooth);
    const auto& printed = shading::paper_counts;
    report::HtmlTable table;
    table.title = fmt::format("Operations for a torus, table 2 ({} smooth)", smooth);
    table.header = {"what", "formula", "printed, n = 415", "computed, n = 415", "n = 416"};
    const auto add = [&](const char* what, const char* formula, int shown, int here, int all) {
        table.rows.push_back(
            {what,
             formula,
             fmt::format("{}{}", shown, shown == here ? "" : " (slip)"),
             fmt::format("{}", here),
             fmt::format("{}", all)});
    };
    add("deciding", "9 n", printed.selection, counts.selection, whole.selection);
    add("all flat", "9 n + n", printed.all_flat, counts.all_flat, whole.all_flat);
    add("all Gouraud", "9 n + 4 n", printed.all_smooth, counts.all_smooth, whole.all_smooth);
    add("hybrid", "9 n + f + 4 g", printed.hybrid, counts.hybrid, whole.hybrid);
    table.note = fmt::format(
        "The torus has 416 triangles (26 x 8 quads in two each; 26 x 9 = 234 vertices with one "
        "seam "
        "doubled); 5408 is 13 x 416, the other rows are of 415. g = {} of 415 is what the mapping "
        "here, round(r n (10 + 3 r) / 13), gives for the paper's relative speed r = {}: the paper "
        "says 8 or 9 and not why.",
        smooth,
        printed_device_ratio);
    return table;
}

report::HtmlTable gain_table(std::span<const ShadingRun> runs) {
    report::HtmlTable table;
    table.title = "Gain of the error rule over the paper's, PSNR against all Gouraud";
    table.header = {
        "model",
        "polygons",
        "facing the eye",
        "smooth",
        "random, dB",
        "paper, dB",
        "paper, facing only, dB",
        "error (ours), dB",
        "gain over paper, dB",
        "least of a view, dB",
        "over facing only, dB",
        "at least 2 dB"};
    for (const ShadingRun& run : runs) {
        for (std::size_t step = 1; step <= 3; ++step) {
            const auto& random = run.rules[random_rule].to_gouraud[step];
            const auto& theirs = run.rules[paper_rule].to_gouraud[step];
            const auto& facing = run.rules[facing_rule].to_gouraud[step];
            const auto& ours = run.rules[error_rule].to_gouraud[step];
            const double gain_db = ours.psnr_db() - theirs.psnr_db();
            table.rows.push_back(
                {run.name,
                 fmt::format("{}", run.polygons),
                 fmt::format("{:.1f} %", 100.0 * run.facing_share),
                 fmt::format("{} %", step * share_step_percent),
                 decibels(random.psnr_db()),
                 decibels(theirs.psnr_db()),
                 decibels(facing.psnr_db()),
                 decibels(ours.psnr_db()),
                 gain_text(ours.psnr_db(), gain_db),
                 gain_text(ours.psnr_db(), min_gain_db(ours, theirs)),
                 gain_text(ours.psnr_db(), ours.psnr_db() - facing.psnr_db()),
                 gain_db >= 2.0 ? "yes" : "no"});
        }
    }
    table.note =
        "Share of all polygons of the model, those that face away included. Eight eyes around the "
        "model, three radii from its middle; PSNR of the mean square error over all covered pixels "
        "of all eyes, white = R + G + B = 3 in display values. Facing only: the paper's "
        "rule as if polygons that face away were not there. Exact: beyond 100 dB, a hundred "
        "thousandth of white. Random: mean square of four seeds.";
    return table;
}

report::HtmlTable quality_table(const ShadingRun& run) {
    report::HtmlTable table;
    table.title = fmt::format("{}: quality over the share of smooth polygons", run.name);
    table.header = {"smooth"};
    for (const char* reference : {"Gouraud", "per pixel"}) {
        for (const char* measure : {"PSNR, dB", "SSIM"}) {
            for (std::size_t rule = 0; rule < studied_rules.size(); ++rule) {
                table.header.push_back(
                    fmt::format("{} to {}, {}", measure, reference, studied_rules[rule].name));
            }
        }
    }
    for (std::size_t step = 0; step < share_steps; ++step) {
        std::vector<std::string> row{fmt::format("{} %", step * share_step_percent)};
        for (const auto reference : {&RuleQuality::to_gouraud, &RuleQuality::to_per_pixel}) {
            for (const RuleQuality& rule : run.rules) {
                row.push_back(decibels((rule.*reference)[step].psnr_db()));
            }
            for (const RuleQuality& rule : run.rules) {
                row.push_back(fmt::format("{:.4f}", (rule.*reference)[step].similarity));
            }
        }
        table.rows.push_back(row);
    }
    table.note = fmt::format(
        "{} polygons, {:.1f} % of them face the eye. Exact: beyond 100 dB. To Gouraud: all "
        "polygons smooth; per pixel: normals between corners (Phong's shading).",
        run.polygons,
        100.0 * run.facing_share);
    return table;
}

report::HtmlTable control_table(std::span<const ControlRun> runs) {
    report::HtmlTable table;
    table.title = "The share of smooth polygons found from frame times";
    table.header = {
        "all smooth cost more, ms",
        "T, ms",
        "best share, a = 3 / 5 / 3 ms",
        "settled after, frames",
        "frames over T",
        "class changes per polygon and second",
        "flat gains"};
    for (const ControlRun& run : runs) {
        table.rows.push_back(
            {fmt::format("{:g}", run.machine.smooth_ms),
             fmt::format("{:g}", run.target_frame_ms),
             fmt::format(
                 "{:.2f} / {:.2f} / {:.2f}",
                 run.best_share[0],
                 run.best_share[1],
                 run.best_share[2]),
             fmt::format(
                 "{} / {} / {}",
                 run.settled_frames[0],
                 run.settled_frames[1],
                 run.settled_frames[2]),
             fmt::format("{:.1f} %", 100.0 * run.over_share),
             fmt::format("{:.3f}", run.changes_per_second),
             run.has_no_gain ? "nothing: all smooth" : "time"});
    }
    const SimulatedMachine machine;
    table.note = fmt::format(
        "A made clock, 416 polygons: all flat take {:g} ms and a; noise of {:g} % (deviation), "
        "{:g} % of the frames 1.6 times as long; 600 frames each of three loads. Best share: the "
        "expected time is 2.6 deviations below T. Settled: within 0.1 of it, or 2.5 deviations of "
        "the noise, for good. Changes: from the 31st frame of each load on, 60 frames a second, "
        "still camera. Where smooth ones gain nothing, and where even all flat takes longer than "
        "T, "
        "frames over T are nobody's fault.",
        machine.flat_ms,
        100.0 * machine.noise,
        100.0 * machine.slow_share);
    return table;
}

} // namespace octant::ui::studies::hybrid_shading
