#pragma once

#include "models/meshfile/level_chain.h"
#include "models/polygons/polygon_model.h"
#include "models/simplify/attribute_seams.h"
#include "models/simplify/paper_simplify.h"
#include "models/simplify/simplify.h"
#include "models/triangle_mesh.h"
#include "ui/base/json_value.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::commands {

/// One level of detail in a chart: a point of the plot and a row of the table.
struct ChartLevel {
    std::size_t faces = 0;
    double error_m = 0.0; ///< the largest distance to the mesh, certified
    std::string made_by;  ///< the command that makes it, or what it is
};

/// A page with a plot and a table of the errors of a mesh's levels of detail by their faces: one HTML text without
/// outside references, without the plot where all levels are exact. `mesh` is the name of its file, `levels` begin with
/// the mesh itself.
std::string chart_page(const std::string& mesh, const std::vector<ChartLevel>& levels, double diagonal_m);

/// Adds what the 2005 paper states about its runs to the figures of `octant simplify`: how the paper was read,
/// contractions, feet of perpendiculars, sums of the errors, and what is no manifold any more because the paper has no
/// test that keeps it.
void add_paper_results(base::JsonValue& results, const models::simplify::PaperOptions& options,
    const models::simplify::PaperResult& result);

struct ChainOptions {
    models::simplify::SimplifyOptions simplify; ///< its goal is not looked at
    std::size_t coarsest_faces = 250;
    std::optional<models::polygons::PolygonModel> polygons; ///< for the end of the chain, axes of the mesh
    /// Called after each level with how many there are and will be about.
    std::function<void(std::size_t done, std::size_t of)> show_level;
};

/// The largest distance between two meshes, both ways, certified, metres.
double certified_distance_m(const models::TriangleMesh& original, const models::TriangleMesh& mesh, int threads);

/// Levels of detail of an oriented manifold (repaired) whose colours may break along seams: half the faces each time,
/// each optimized and its distance to the mesh certified. Where no polygons are given and the last level has at most
/// 300 triangles, these are the polygons.
models::meshfile::LevelChain level_chain(const models::simplify::AttributeSeams& seams, const ChainOptions& options);

} // namespace octant::ui::commands
