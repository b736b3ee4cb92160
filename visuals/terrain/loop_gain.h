#pragma once

#include "visuals/terrain/mesher.h"

namespace octant::visuals::terrain {

/// N'(C), in triangles for a unit of C, around `detail.resolution`: the difference of two meshes 4
/// % of C apart, so that single steps of N(C) do not matter. Divided by a of equation (4) it is the
/// loop gain g.
double triangles_gained(Mesher& mesher, const MeshView& view, const Detail& detail);

} // namespace octant::visuals::terrain
