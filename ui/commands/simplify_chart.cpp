// A page that shows what each level of detail of a mesh costs, so that one can be picked by sight.
#include "ui/commands/simplify_chart.h"

#include "models/measure/mesh_defects.h"
#include "models/measure/mesh_distance.h"
#include "models/polygons/polygon_model.h"
#include "ui/report/html_text.h"
#include "ui/report/plots.h"
#include "ui/report/table.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::commands {

namespace {

using Levels = std::vector<ChartLevel>;

report::Plot plot_of(const Levels& levels) {
    report::PlotSeries errors{"largest distance", "#1d6fd1", report::PlotSeries::Style::Points};
    for (const ChartLevel& level : levels) {
        if (level.error_m > 0.0) { // A logarithmic axis shows no exact ones.
            errors.x.push_back(static_cast<double>(level.faces));
            errors.y.push_back(level.error_m);
        }
    }
    report::Plot plot{"Largest distance by the number of faces", "faces", "largest distance to the mesh, in its units",
        {std::move(errors)}};
    plot.x_logarithmic = true;
    plot.y_logarithmic = true;
    return plot;
}

report::ResultTable table_of(const Levels& levels, double diagonal_m) {
    report::ResultTable table;
    for (const ChartLevel& level : levels) {
        table.add({{"faces", level.faces}, {"largest distance", "{:.4g}", level.error_m},
            {"% of the diagonal", "{:.3g}", 100.0 * level.error_m / diagonal_m}, {"made by", level.made_by}});
    }
    table.note = "The largest distance is certified: no point of either surface is farther from the "
                 "other one. It is in the units of the file, before coordinates are rounded by the format "
                 "of OUT.";
    return table;
}

} // namespace

std::string chart_page(const std::string& mesh, const Levels& levels, double diagonal_m) {
    const report::Plot plot = plot_of(levels);
    std::string html = report::page_head("Faces against error of " + mesh, "octant simplify --chart");
    if (!plot.series.front().x.empty()) {
        html += report::card_html(report::page_plot(plot, report::PlotWidth::FullWidth));
    }
    return html + report::card_html(report::html_of(table_of(levels, diagonal_m))) + report::page_end();
}

namespace {

std::string reading_of(const models::simplify::PaperOptions& options) {
    const std::string distances = options.colour_weight > 0.0
                                      ? fmt::format("squared, in position and {:.3g} x colour", options.colour_weight)
                                      : "squared, in position";
    return fmt::format("shortest edge first; the better of both ends and the middle; faces of either end once; "
                       "distances {}; a foot is inside for 0 < a, b, c < 1; vertices of no face are counted",
        distances);
}

} // namespace

void add_paper_results(base::JsonValue& results, const models::simplify::PaperOptions& options,
    const models::simplify::PaperResult& result) {
    results["reading"] = reading_of(options);
    results["contractions"] = result.contractions;
    results["counted_vertices"] = result.counted_vertices;
    results["feet"] = result.feet;
    results["feet_outside"] = result.feet_outside;
    if (result.feet > 0) { // the plane's measure has none
        results["share_outside"] = static_cast<double>(result.feet_outside) / static_cast<double>(result.feet);
    }
    results["error_sum_plane"] = result.sums.plane_m2;
    results["error_sum_triangle"] = result.sums.triangle_m2;
    results["error_sum_bidirectional"] = result.sums.bidirectional_m2;
    const models::measure::MeshDefects defects = models::measure::defects(result.mesh);
    results["duplicate_faces"] = defects.duplicate_faces;
    results["non_manifold_edges"] = defects.non_manifold_edges;
}

namespace {

using models::TriangleMesh;

constexpr std::size_t max_polygons = 300; ///< that draw orders are found for quickly

std::vector<std::size_t> face_goals(std::size_t faces, std::size_t coarsest) {
    std::vector<std::size_t> goals;
    for (std::size_t goal = faces / 2; goal > coarsest; goal /= 2) { goals.push_back(goal); }
    if (coarsest < faces) { goals.push_back(coarsest); }
    return goals;
}

} // namespace

double certified_distance_m(const TriangleMesh& original, const TriangleMesh& mesh, int threads) {
    return models::measure::distance(original, mesh,
        {.negligible_m = 1e-6 * models::diagonal_m(original), .samples = 0, .threads = threads, .maximum_only = true})
        .max_hausdorff_m();
}

models::meshfile::LevelChain level_chain(const models::simplify::AttributeSeams& seams, const ChainOptions& options) {
    const TriangleMesh& original = seams.marked();
    constexpr double larger = 1.0 + 1e-9; // errors of a chain rise from level to level
    models::simplify::SimplifyOptions simplify = options.simplify;
    simplify.keep_topology = true; // all levels are states of one sequence of collapses
    simplify.goal = {.vertices = {}, .faces = options.coarsest_faces, .error_m = {}};
    const std::vector<std::size_t> goals = face_goals(original.triangles.size(), options.coarsest_faces);
    const models::simplify::Simplified coarsest = models::simplify::simplified(original, simplify);
    const models::CollapseSequence& sequence = coarsest.sequence;
    models::meshfile::LevelChain chain;
    chain.name = original.name;
    chain.levels.push_back({seams.with_attributes(original), 0.0});
    for (const std::size_t goal : goals) {
        const std::size_t collapses = models::collapses_to_faces(sequence, goal);
        TriangleMesh level = models::mesh_after(sequence, collapses);
        if (collapses == sequence.collapses.size()) {
            level = coarsest.mesh;
        } else {
            level = models::simplify::optimized(level, original, simplify);
        }
        if (level.triangles.size() < chain.levels.back().mesh.triangles.size()) {
            const double before_m = chain.levels.back().error_m;
            const double error_m = certified_distance_m(original, level, simplify.threads);
            const double min_m = std::max(before_m * larger, 1e-12 * models::diagonal_m(original));
            chain.levels.push_back({seams.with_attributes(std::move(level)), std::max(error_m, min_m)});
        }
        if (options.show_level) { options.show_level(chain.levels.size() - 1, goals.size()); }
    }
    const TriangleMesh& last = chain.levels.back().mesh;
    chain.polygons = options.polygons;
    if (!chain.polygons && last.triangles.size() <= max_polygons) {
        chain.polygons = models::polygons::polygons_from_mesh(last);
    }
    if (chain.polygons) {
        chain.polygons_error_m = options.polygons
                                     ? certified_distance_m(original,
                                           models::polygons::mesh_from_polygons(*chain.polygons), simplify.threads)
                                     : chain.levels.back().error_m;
    }
    return chain;
}

} // namespace octant::ui::commands
