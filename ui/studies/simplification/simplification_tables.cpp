// The tables of the simplification paper with ours beside.
//
// Source: Y. Kim, B. U. Lee, "Error measure for vertex simplification", 2005, tables 1 and 2,
// figures 5 and 6.
#include "ui/studies/simplification/simplification_tables.h"

#include "ui/report/plots.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace octant::ui::studies::simplification {

namespace {

using models::simplify::PaperMeasure;

/// What the paper prints of one model.
struct Printed {
    const char* mesh;
    std::size_t feet_inside;
    std::size_t feet_outside;
    std::array<double, 3> errors;     ///< by PaperMeasure
    std::array<std::size_t, 3> faces; ///< of the result, the same
};

constexpr std::array printed = {
    Printed{"bunny", 281616, 2501472, {4.34e-5, 3.65e-5, 3.65e-5}, {1725, 1725, 1725}},
    Printed{"globe", 234588, 2479236, {2.56e-5, 2.03e-5, 1.98e-5}, {9944, 9907, 9907}}};

const Printed* printed_of(const PaperRun& run) {
    const auto* found = std::find_if(printed.begin(), printed.end(), [&](const Printed& model) {
        return run.mesh == model.mesh;
    });
    return found == printed.end() ? nullptr : found;
}

const char* name_of(PaperMeasure measure) {
    switch (measure) {
    case PaperMeasure::Plane:
        return "previous";
    case PaperMeasure::Triangle:
        return "one direction";
    case PaperMeasure::Bidirectional:
        break;
    }
    return "both directions";
}

const char* name_of(ColourReading colour) {
    switch (colour) {
    case ColourReading::None:
        return "no";
    case ColourReading::Distance:
        return "distances";
    case ColourReading::DistanceAndLength:
        break;
    }
    return "distances, edge lengths";
}

/// "12 of 34 = 35.29 %".
std::string share_text(std::size_t part, std::size_t all) {
    return fmt::format(
        "{} of {} = {:.2f} %",
        part,
        all,
        100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1)));
}

std::vector<std::string> error_row(const PaperRun& run, const PaperRun& previous) {
    const Printed* paper = printed_of(run);
    const auto index = static_cast<std::size_t>(run.measure);
    const auto& sums = run.result.sums;
    const auto& before = previous.result.sums;
    return {
        run.mesh,
        name_of(run.colour),
        name_of(run.measure),
        paper == nullptr ? "" : fmt::format("{:.2e}", paper->errors[index]),
        paper == nullptr ? "" : fmt::format("{:.2f}", paper->errors[index] / paper->errors[0]),
        fmt::format("{:.4e}", sums.triangle_m2),
        fmt::format("{:.3f}", sums.triangle_m2 / before.triangle_m2),
        fmt::format("{:.4e}", sums.bidirectional_m2),
        fmt::format("{:.3f}", sums.bidirectional_m2 / before.bidirectional_m2),
        paper == nullptr ? "" : fmt::format("{}", paper->faces[index]),
        fmt::format("{}", run.result.mesh.triangles.size()),
        fmt::format("{}", run.result.mesh.vertices_m.size()),
        fmt::format("{}", run.defects.duplicate_faces),
        fmt::format("{}", run.defects.non_manifold_edges),
        fmt::format("{:.3f}", 1e3 * run.distance.max_hausdorff_m() / run.diagonal_m),
        fmt::format("{:.3f}", 1e4 * run.distance.rms_m() / run.diagonal_m),
        fmt::format("{:.0f}", run.time_ms)};
}

/// Whether a result has the faces asked for, and not many more.
bool is_at_goal(const QualityRun& run) {
    return static_cast<double>(run.faces) <= 1.02 * static_cast<double>(run.target_faces);
}

/// The least value of the libraries on the same mesh at the same goal, of those that reach it.
template <typename Value>
std::optional<double>
best_peer_value(std::span<const QualityRun> runs, const QualityRun& reference, const Value& value) {
    std::optional<double> best;
    for (const QualityRun& run : runs) {
        if (run.peer && is_at_goal(run) && run.mesh == reference.mesh &&
            run.target_faces == reference.target_faces) {
            best = std::min(best.value_or(std::numeric_limits<double>::infinity()), value(run));
        }
    }
    return best;
}

std::optional<double>
time_of_lindstrom_turk(std::span<const QualityRun> runs, const QualityRun& reference) {
    for (const QualityRun& run : runs) {
        if (run.lindstrom_turk_name && run.mesh == reference.mesh &&
            run.target_faces == reference.target_faces) {
            return run.time_ms;
        }
    }
    return std::nullopt;
}

std::string ratio_text(double value, const std::optional<double>& to) {
    return to && *to > 0.0 ? fmt::format("{:.2f}", value / *to) : "";
}

/// Of two distances as fractions of the diagonal: below 1e-8 they are rounding.
std::string distance_ratio_text(double value, const std::optional<double>& to) {
    constexpr double exact = 1e-8;
    if (!to || *to >= exact) {
        return ratio_text(value, to);
    }
    return value < exact ? "both exact" : "library exact";
}

std::vector<std::string>
names_in_order(std::span<const QualityRun> runs, std::string QualityRun::*name) {
    std::vector<std::string> names;
    for (const QualityRun& run : runs) {
        if (std::find(names.begin(), names.end(), run.*name) == names.end()) {
            names.push_back(run.*name);
        }
    }
    return names;
}

report::PlotSeries
series_of(std::span<const QualityRun> runs, const std::string& mesh, const std::string& method) {
    report::PlotSeries series;
    series.name = method;
    for (const QualityRun& run : runs) {
        if (run.mesh == mesh && run.method == method && run.rms > 0.0) {
            series.x.push_back(static_cast<double>(run.faces));
            series.y.push_back(run.rms);
        }
    }
    return series;
}

} // namespace

std::string paper_reading_text() {
    return fmt::format(
        "# Simplification by distances to triangles (Y. Kim, B. U. Lee, 2005)\n\n"
        "How the paper is read, where it leaves a choice:\n\n"
        "- The shortest edge goes first, in space; equal lengths by the numbers of the vertices. "
        "It becomes one of its ends or the middle, whichever costs least. No test keeps a "
        "manifold.\n"
        "- A cost is a sum of squared distances: of the new vertex to the faces of both ends, each "
        "once (one direction); of both old ends to the same faces as moved, those that collapse "
        "too; both directions: the larger sum. Previous: quadrics of planes.\n"
        "- A foot is inside for 0 < a, b, c < 1: corners and borders are outside, and so is all of "
        "a collapsed triangle. The share hangs on these points.\n"
        "- Vertices that no triangle uses are counted: the bunny has 1113, and only so do 2000 "
        "points have 1725 faces.\n"
        "- The globe is made: 192 meridians, 192 rings, two poles, 1 m radius, land from Natural "
        "Earth. Colour counts in distances as three more directions, w rgb with w = {:g} m, and "
        "in the length of edges too where the table says so.\n"
        "- The paper's error is the sum over all contractions, each against the mesh before. Its "
        "unit is not said, and its values were not found again; what can be compared is each "
        "measure against the previous one.\n\n",
        globe_colour_weight_m);
}

report::HtmlTable feet_table(std::span<const PaperRun> runs) {
    report::HtmlTable table;
    table.title = "Table 1: perpendiculars whose foot lies outside the triangle";
    table.header = {"mesh", "colour in", "paper: outside", "ours: outside"};
    for (const PaperRun& run : runs) {
        if (run.measure != PaperMeasure::Bidirectional) {
            continue;
        }
        const Printed* paper = printed_of(run);
        table.rows.push_back(
            {run.mesh,
             name_of(run.colour),
             paper == nullptr
                 ? ""
                 : share_text(paper->feet_outside, paper->feet_inside + paper->feet_outside),
             share_text(run.result.feet_outside, run.result.feet)});
    }
    table.note = "Of the runs by both directions: three candidates for each edge, three points for "
                 "each face. The paper's numbers of perpendiculars can be divided by nine too.";
    return table;
}

report::HtmlTable paper_error_table(std::span<const PaperRun> runs) {
    report::HtmlTable table;
    table.title = "Table 2: error summed over all contractions";
    table.header = {
        "mesh",
        "colour in",
        "measure",
        "paper: error",
        "paper: of previous",
        "one-way sum, m2",
        "of previous",
        "two-way sum, m2",
        "of previous",
        "paper: faces",
        "faces",
        "vertices used",
        "duplicate faces",
        "edges of 3+ faces",
        "Hausdorff, 1e-3",
        "RMS, 1e-4",
        "ms"};
    const PaperRun* previous = nullptr;
    for (const PaperRun& run : runs) {
        previous = run.measure == PaperMeasure::Plane ? &run : previous;
        table.rows.push_back(error_row(run, *previous));
    }
    table.note =
        "The sums are taken of every run by the same two rulers, whichever measure chose: squared "
        "distances of new vertices to the triangles they replace, and the larger sum of both ways. "
        "Hausdorff (certified upper bound, 2 % wide) and RMS are the larger one of both ways "
        "between result and original, of positions only, as fractions of the diagonal: the paper's "
        "sums fall while "
        "these may rise, as each step is compared with the mesh before it only.";
    return table;
}

report::HtmlTable quality_table(std::span<const QualityRun> runs, bool with_peers) {
    report::HtmlTable table;
    table.title = "Distance to the original, and time";
    table.header = {
        "mesh",
        "method",
        "wanted faces",
        "faces",
        "Hausdorff, 1e-3",
        "RMS, 1e-4",
        "colour RMS",
        "Hausdorff / best library",
        "RMS / best library",
        "time, ms",
        "time / Lindstrom-Turk"};
    for (const QualityRun& run : runs) {
        const auto hausdorff =
            best_peer_value(runs, run, [](const QualityRun& r) { return r.hausdorff; });
        const auto rms = best_peer_value(runs, run, [](const QualityRun& r) { return r.rms; });
        table.rows.push_back(
            {run.mesh,
             run.method,
             fmt::format("{}", run.target_faces),
             fmt::format("{}", run.faces),
             fmt::format("{:.3f}", 1e3 * run.hausdorff),
             fmt::format("{:.3f}", 1e4 * run.rms),
             run.colour_rms ? fmt::format("{:.4f}", *run.colour_rms) : "",
             distance_ratio_text(run.hausdorff, hausdorff),
             distance_ratio_text(run.rms, rms),
             fmt::format("{:.1f}", run.time_ms),
             ratio_text(run.time_ms, time_of_lindstrom_turk(runs, run))});
    }
    table.note =
        "Both ways between result and repaired original, the larger one, as fractions of the "
        "diagonal; Hausdorff is a certified upper bound, 2 % wide. One thread, wall time without "
        "reading and writing; of the libraries the median of three. The libraries are given "
        "positions only; the best one is that of those that came down to the faces wanted.";
    if (!with_peers) {
        table.note += " No libraries: build the target octant_peers (needs CGAL, meshoptimizer or "
                      "OpenMesh) and name the program octant-peers by --peers.";
    }
    return table;
}

std::string quality_figure(std::span<const QualityRun> runs) {
    constexpr std::array colours = {
        "#d62728", "#ff7f0e", "#777777", "#2ca02c", "#1f77b4", "#17becf", "#9467bd"};
    const std::vector<std::string> methods = names_in_order(runs, &QualityRun::method);
    std::vector<report::Plot> panels;
    for (const std::string& mesh : names_in_order(runs, &QualityRun::mesh)) {
        report::Plot plot;
        plot.title = mesh;
        plot.x_label = "faces";
        plot.y_label = "RMS / diagonal";
        plot.y_logarithmic = true;
        for (std::size_t i = 0; i < methods.size(); ++i) {
            report::PlotSeries series = series_of(runs, mesh, methods[i]);
            series.colour = colours[i % colours.size()];
            if (series.x.size() > 1) {
                plot.series.push_back(std::move(series));
            }
        }
        if (!plot.series.empty()) {
            panels.push_back(std::move(plot));
        }
    }
    return panels.empty() ? "" : report::plots_png(panels).value_or("");
}

} // namespace octant::ui::studies::simplification
