#pragma once

#include "models/simplify/collapsible_mesh.h"
#include "models/simplify/vertex_quadrics.h"
#include "models/simplify/working_surface.h"

#include <span>

namespace octant::models::simplify {

/// Where P. Lindstrom and G. Turk (1998) place the vertex that an edge collapses into, and its cost
/// there: both from the present triangles around the edge alone, without memory of the original.
/// The volume that the surface encloses and the area that a boundary encloses stay, and what the
/// single triangles sweep is least. `ring` is the ring of the edge (CollapsibleMesh::ring_of).
/// Lengths are in working units; colours are left out.
Placement
volume_placement(const WorkingSurface& surface, HalfEdge edge, std::span<const RingFace> ring);

} // namespace octant::models::simplify
