#pragma once

#include "models/triangle_mesh.h"

#include <cstddef>
#include <string>
#include <vector>

namespace octant::models::repair {

/// What was found and mended in a mesh.
struct RepairCounts {
    std::size_t unreferenced_vertices = 0; ///< taken out, also what the triangles below leave
    std::size_t duplicate_vertices = 0;    ///< welded: one place (-0 is 0), or rims that nearly touch
    std::size_t degenerate_triangles = 0;  ///< two corners in one vertex, or no area: taken out
    /// Taken out: the same three vertices again, where no closed shell needs them.
    std::size_t duplicate_triangles = 0;
    std::size_t flipped_triangles = 0; ///< turned to agree with their neighbours
    std::size_t split_edges = 0;       ///< shared by more than two triangles, or by two that disagree
    std::size_t split_vertices = 0;    ///< where several fans met: each got a vertex of its own
    std::size_t boundary_loops = 0;    ///< holes; carried through
    std::size_t shells = 0;            ///< connected pieces

    bool operator==(const RepairCounts&) const = default;
};

/// One line each for what was found, in words a user reads; empty for a closed mesh without faults.
std::vector<std::string> describe_counts(const RepairCounts& counts);

/// Whether vertices at one place are one. Files double vertices where normals, colours or pictures break: Welded closes
/// these seams and rims a rounding apart (a millionth of the diagonal), a vertex then has the mean of the colours
/// there. Apart welds only what agrees to the bit, colours too.
enum class Seams { Welded, Apart };

struct RepairedMesh {
    TriangleMesh mesh; ///< every edge in one or two triangles, every vertex with one fan
    /// One a triangle where colours break along seams that were welded: what the file says, while the mesh's colours
    /// are means. Empty where none break.
    std::vector<CornerColours> corner_colours;
    RepairCounts counts;
};

/// Makes an oriented manifold, perhaps with boundary and of several shells, out of a mesh as found in the field.
/// Vertices and triangles that stay keep their order. Nothing but rims that nearly touch moves; triangles that are only
/// degenerate by area are taken out too. Where shells touch along an edge each keeps its own, if their triangles named
/// it by vertices of their own or if each is closed. A closed shell stays closed; where it touches itself along an
/// edge, a vertex in the middle of the edge is added.
RepairedMesh repaired(TriangleMesh mesh, Seams seams = Seams::Welded);

} // namespace octant::models::repair
