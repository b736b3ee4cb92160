#pragma once

#include "models/meshfile/level_chain.h"
#include "models/polygons/polygon_model.h"
#include "models/simplify/attribute_seams.h"
#include "models/simplify/simplify.h"

#include <cstddef>
#include <functional>
#include <optional>

namespace octant::ui::commands {

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
