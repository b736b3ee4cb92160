#pragma once

#include "visuals/terrain/quadtree_mesher.h"

namespace octant::visuals::terrain {

/// The resolution C at which a mesh comes nearest to `target_triangles` from this view, by bisection between the tree's
/// smallest one and `max_resolution`; `detail.resolution` is not used. It counts about 24 meshes, so it is meant for
/// loading, where it lets the first picture of a run meet its target already.
double resolution_for_target(QuadtreeMesher& mesher, const MeshView& view, const QuadtreeDetail& detail,
    double target_triangles, double max_resolution);

/// N'(C), in triangles for a unit of C, around `detail.resolution`: the difference of two meshes 4 % of C apart, so
/// that single steps of N(C) do not matter. Divided by a of equation (4) it is the loop gain g.
double triangle_count_slope(QuadtreeMesher& mesher, const MeshView& view, const QuadtreeDetail& detail);

} // namespace octant::visuals::terrain
