#pragma once

#include "models/repair/repair_counts.h"
#include "models/triangle_mesh.h"

#include <vector>

namespace octant::models::repair {

/// Whether vertices at one place are one. Files double vertices where normals, colours or pictures
/// break: Welded closes these seams and rims a rounding apart (a millionth of the diagonal), a
/// vertex then has the mean of the colours there. Apart welds only what agrees to the bit, colours
/// too.
enum class Seams { Welded, Apart };

struct RepairedMesh {
    TriangleMesh mesh; ///< every edge in one or two triangles, every vertex with one fan
    /// One a triangle where colours break along seams that were welded: what the file says, while
    /// the mesh's colours are means. Empty where none break.
    std::vector<CornerColours> corner_colours;
    RepairCounts counts;
};

/// Makes an oriented manifold, perhaps with boundary and of several shells, out of a mesh as found
/// in the field. Vertices and triangles that stay keep their order. Nothing but rims that nearly
/// touch moves; triangles that are only degenerate by area are taken out too. Where shells touch
/// along an edge each keeps its own, if their triangles named it by vertices of their own or if each
/// is closed. A closed shell stays closed; where it touches itself along an edge, a vertex in the
/// middle of the edge is added.
RepairedMesh repaired(TriangleMesh mesh, Seams seams = Seams::Welded);

} // namespace octant::models::repair
