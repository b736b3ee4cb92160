#pragma once

#include "models/simplify/polish_target.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// What makes a triangle one of those that need another vertex most.
enum class SplitBy {
    Peaks,  ///< Its largest distance.
    Squares ///< Its sum of squared distances.
};

/// For each triangle of a surface none of whose triangles has gone how much it needs another
/// vertex, by its distances both ways. Each tracked point must be in the list of a triangle that is
/// near.
std::vector<double> split_needs(
    const WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    SplitBy split_by);

/// The mesh with `count` edges, or as many as there are apart from each other, split in the middle:
/// the longest ones of the triangles with the largest needs. No triangle is split twice. Normals
/// are left out.
TriangleMesh
with_split_edges(const TriangleMesh& mesh, std::span<const double> needs, std::size_t count);

} // namespace octant::models::simplify
