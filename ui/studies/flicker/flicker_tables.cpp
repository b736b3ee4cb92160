#include "ui/studies/flicker/flicker_tables.h"

#include "visuals/terrain/count_statistics.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <optional>

namespace octant::ui::studies::flicker {

namespace {

namespace terrain = visuals::terrain;

const FlickerSettings standard;

std::string frames_text(const std::optional<int>& frames) {
    return frames ? fmt::format("{}", *frames) : "never";
}

/// N, or the two between which it alternates.
std::string last_two(const std::vector<int>& counts) {
    const int last = counts.back();
    const int before = counts[counts.size() - 2];
    return last == before ? fmt::format("{}", last)
                          : fmt::format("{} / {}", std::max(last, before), std::min(last, before));
}

report::HtmlTable fixed_table(const FieldRuns& runs, const char* kind) {
    constexpr std::size_t last = 50;
    report::HtmlTable table;
    table.title = fmt::format("Fixed view over {} ground: {}", kind, runs.name);
    table.header = {
        "c",
        "loop gain g",
        "control",
        "mean abs dn, last 50",
        "fans, last two frames",
        "dn = 0 for ever after, frames",
        "within 0.5 % after, frames"};
    for (std::size_t weight = 0; weight < runs.fixed.size(); ++weight) {
        for (std::size_t triangle_control = 0; triangle_control < runs.fixed[weight].size(); ++triangle_control) {
            const FlickerRun& run = runs.fixed[weight][triangle_control];
            const auto changes = terrain::change_statistics(
                run.triangles, std::max(run.triangles.size(), last + 1) - last);
            table.rows.push_back(
                {fmt::format("{:g}", flicker_weights[weight]),
                 fmt::format("{:.2f}", runs.fixed_gains[weight]),
                 triangle_controls()[triangle_control].name,
                 fmt::format("{:.0f}", changes.mean),
                 last_two(run.fans),
                 frames_text(terrain::frames_until_constant(run.triangles, 10)),
                 frames_text(terrain::frames_until_within(
                     run.triangles, standard.target_triangles, 0.005, 10))});
        }
    }
    table.note = fmt::format(
        "{} frames of one view, 300 m over the ground: the one of 25 places and eight headings "
        "that is refined most. Literal roughness, partial fans, C_min = 2, K = 0.5 + 0.79 / C_min "
        "= "
        "0.895, N_target = {}, a = {:g}, C_0 = {:g}, r = {}. g = N'(C) / a where N = N_target, "
        "over "
        "4 % of C. Within 0.5 %: of N_target, first of ten such frames in a row; for ever: at "
        "least the last ten frames. The paper (Grand "
        "Canyon, numbers not given): c = 1 best, c = 2 settles, c = 3 and more oscillate for ever, "
        "its pair of frames has 5256 / 2745 fans. Screen error: the default mesh, with geomorphs, "
        "at the error in pixels that gives N_target; it has neither c nor C.",
        runs.fixed.front().front().triangles.size(),
        standard.target_triangles,
        standard.triangles_per_resolution,
        standard.first_resolution,
        standard.averaged_frames);
    return table;
}

void add_path_rows(const FieldRuns& runs, report::HtmlTable& table) {
    const double gain = std::accumulate(runs.path_gains.begin(), runs.path_gains.end(), 0.0) /
                        static_cast<double>(runs.path_gains.size());
    const double most = *std::max_element(runs.path_gains.begin(), runs.path_gains.end());
    const auto changes_of = [](const FlickerRun& run) {
        return terrain::change_statistics(run.triangles, first_measured(run.triangles.size()));
    };
    const double before = changes_of(runs.path[previous_control]).mean;
    for (std::size_t triangle_control = 0; triangle_control < runs.path.size(); ++triangle_control) {
        const FlickerRun& run = runs.path[triangle_control];
        if (run.triangles.empty()) {
            continue;
        }
        const terrain::ChangeStatistics changes = changes_of(run);
        table.rows.push_back(
            {runs.name,
             fmt::format("{:.2f}", gain),
             fmt::format("{:.2f}", most),
             triangle_controls()[triangle_control].name,
             fmt::format("{:.1f}", changes.mean),
             fmt::format("{}", changes.largest),
             fmt::format("{:.1f}", changes.flicker_triangles),
             frames_text(
                 terrain::frames_until_within(run.triangles, standard.target_triangles, 0.02, 10)),
             changes.mean > 0.0 ? fmt::format("{:.1f}", before / changes.mean) : ""});
    }
}

report::HtmlTable path_table(const FlickerRuns& runs) {
    report::HtmlTable table;
    table.title =
        fmt::format("Path of {} frames, c = 5", runs.rugged.path[previous_control].triangles.size());
    table.header = {
        "ground",
        "g, mean",
        "g, largest",
        "control",
        "mean abs dn",
        "largest abs dn",
        "alternation",
        "within 2 % after, frames",
        "previous / this"};
    add_path_rows(runs.gentle, table);
    add_path_rows(runs.rugged, table);
    table.note =
        "Once round an ellipse of 0.6 by 0.4 of the field, 300 m over the ground, looking ahead; "
        "settings as at the fixed view. The first 20 changes are left out. Alternation: sum of "
        "min(|dn_k|, |dn_k-1|) over the frames in which dn changes its sign, divided by all "
        "frames: "
        "triangles that come and go again. Within 2 %: of N_target, first of ten such frames in a "
        "row. Screen error has neither c nor g.";
    return table;
}

report::HtmlTable damping_table(const FlickerRuns& runs) {
    report::HtmlTable table;
    table.title = fmt::format("Damping over r: {}, path, c = 5", runs.rugged.name);
    table.header = {"r", "mean abs dn", "largest abs dn", "alternation"};
    for (std::size_t k = 0; k < runs.damping_lengths.size(); ++k) {
        const auto changes = terrain::change_statistics(
            runs.damping_lengths[k].triangles, first_measured(runs.damping_lengths[k].triangles.size()));
        table.rows.push_back(
            {fmt::format("{}", damping_frame_counts[k]),
             fmt::format("{:.1f}", changes.mean),
             fmt::format("{}", changes.largest),
             fmt::format("{:.1f}", changes.flicker_triangles)});
    }
    table.note =
        "Equation (5) as printed, weights r + 1, ..., 2, 1; r = 0 is the previous control. The "
        "paper: r = 4 is best.";
    return table;
}

void add_stability_rows(const FieldRuns& runs, report::HtmlTable& table) {
    for (std::size_t k = 0; k < runs.settling_frames.size(); ++k) {
        std::vector<std::string> row = {
            runs.name, triangle_controls()[dead_band_control].name, fmt::format("{:g}", flicker_gains[k])};
        for (const auto& frames : runs.settling_frames[k]) {
            row.push_back(frames_text(frames));
        }
        table.rows.push_back(row);
    }
    std::vector<std::string> row = {runs.name, triangle_controls()[exact_control].name, "any"};
    row.resize(row.size() + flicker_first.size(), frames_text(runs.settling_frames_exact));
    table.rows.push_back(row);
}

report::HtmlTable stability_table(const FlickerRuns& runs) {
    report::HtmlTable table;
    table.title = "Frames before dn = 0 for ever at the fixed view, c = 5";
    table.header = {"ground", "control", "g"};
    for (const double first : flicker_first) {
        table.header.push_back(fmt::format("C_0 = {:g}", first));
    }
    add_stability_rows(runs.gentle, table);
    add_stability_rows(runs.rugged, table);
    table.note = "a = N'(C) / g, with N' measured where N = N_target. The dead band is 0.5 % of "
                 "N_target, or one step of N(C) where that is higher. The exact way has neither g "
                 "nor C_0.";
    return table;
}

} // namespace

std::vector<NamedTable> flicker_tables(const FlickerRuns& runs) {
    return {
        {"fixed-rugged", fixed_table(runs.rugged, "rugged")},
        {"fixed-gentle", fixed_table(runs.gentle, "gentle")},
        {"path", path_table(runs)},
        {"damping", damping_table(runs)},
        {"stability", stability_table(runs)}};
}

} // namespace octant::ui::studies::flicker
