#pragma once

#include "visuals/terrain/mesher.h"

namespace octant::visuals::terrain {

/// The resolution C at which a mesh comes nearest to `target_triangles` from this view, by
/// bisection between the tree's smallest and `max_resolution`; `detail.resolution` is not looked
/// at. Makes about 24 meshes: work for loading, so that the first picture of a run already meets
/// its target.
double settled_resolution(
    Mesher& mesher,
    const MeshView& view,
    const Detail& detail,
    double target_triangles,
    double max_resolution);

} // namespace octant::visuals::terrain
