#pragma once

#include "visuals/terrain/mesher.h"

namespace octant::visuals::terrain {

/// The resolution C at which a mesh comes nearest to `target_triangles` from this view, by
/// bisection between the tree's smallest one and `max_resolution`; `detail.resolution` is not used.
/// It counts about 24 meshes, so it is meant for loading, where it lets the first picture of a run
/// meet its target already.
double settled_resolution(
    Mesher& mesher,
    const MeshView& view,
    const Detail& detail,
    double target_triangles,
    double max_resolution);

/// N'(C), in triangles for a unit of C, around `detail.resolution`: the difference of two meshes 4
/// % of C apart, so that single steps of N(C) do not matter. Divided by a of equation (4) it is the
/// loop gain g.
double triangles_gained(Mesher& mesher, const MeshView& view, const Detail& detail);

} // namespace octant::visuals::terrain
