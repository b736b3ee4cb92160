#pragma once

#include "models/simplify/collapsing_surface.h"
#include "models/simplify/target_mesh.h"
#include "models/simplify/tracked_points.h"
#include "models/simplify/working_surface.h"

#include <cstddef>

namespace octant::models::simplify {

/// About `wanted` points of the target in the lists of their nearest triangles of a surface none of
/// whose triangles has gone.
TrackedPoints
points_on(const WorkingSurface& surface, const TargetMesh& target, std::size_t wanted);

/// About `wanted` points of the target in the lists of triangles near them of what became of it,
/// found by following the collapses of the vertices: near enough for list_nearer to start from.
TrackedPoints
points_carried(const CollapsingSurface& collapsing, const TargetMesh& target, std::size_t wanted);

/// Moves each tracked point to the list of the nearest triangle among those that share a vertex
/// with its present one. `threads` does not change the result.
void list_nearer(const WorkingSurface& surface, TrackedPoints& points, int threads);

/// Measures the distance of each tracked point to the triangle in whose list it is.
void measure_lists(const WorkingSurface& surface, TrackedPoints& points);

} // namespace octant::models::simplify
