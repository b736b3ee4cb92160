#include "ui/commands/chain_maker.h"

#include "models/measure/mesh_distance.h"
#include "models/polygons/polygon_model.h"

#include <algorithm>
#include <array>
#include <utility>

namespace octant::ui::commands {

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
