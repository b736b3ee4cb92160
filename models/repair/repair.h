#pragma once

#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace octant::models::repair {

/// The faults found and repaired in a mesh.
struct RepairCounts {
    std::size_t unreferenced_vertices = 0; ///< removed, also after triangles were removed
    std::size_t duplicate_vertices = 0;    ///< welded: equal positions (-0 equals 0), or boundaries that nearly touch
    std::size_t degenerate_triangles = 0;  ///< two equal corners, or no area: removed
    /// Removed: the same three vertices again, unless a closed shell needs them.
    std::size_t duplicate_triangles = 0;
    std::size_t flipped_triangles = 0; ///< reversed to agree with their neighbours
    std::size_t split_edges = 0;       ///< shared by more than two triangles, or by two that disagree
    std::size_t split_vertices = 0;    ///< several fans met: each fan got its own vertex
    std::size_t boundary_loops = 0;    ///< holes; not closed
    std::size_t shells = 0;            ///< connected pieces

    bool operator==(const RepairCounts&) const = default;
};

/// Describes each kind of fault in a line for the user; empty for a closed mesh without faults.
std::vector<std::string> describe_counts(const RepairCounts& counts);

/// How vertices at one position are welded. Files have several vertices at one position where normals, colours or
/// textures are discontinuous. Welded closes these seams, and gaps of at most a millionth of the diagonal; a welded
/// vertex has the mean colour. Apart welds only vertices that are equal bit for bit, colours included.
enum class Seams { Welded, Apart };

struct RepairedMesh {
    TriangleMesh mesh; ///< every edge has one or two triangles, every vertex one fan
    /// The file's colours, one entry for each triangle, where colours are discontinuous along welded seams (the mesh's
    /// colours are means). Empty where they are continuous.
    std::vector<CornerColours> corner_colours;
    RepairCounts counts;
};

/// Converts any triangle mesh to an oriented manifold, which may have boundaries and several shells. Remaining vertices
/// and triangles keep their order. Only boundaries that nearly touch are moved. Where shells touch along an edge, each
/// keeps its own edge if their triangles used different vertices or if each shell is closed. A closed shell stays
/// closed; where it touches itself along an edge, a vertex is added in the middle of the edge.
RepairedMesh repaired(TriangleMesh mesh, Seams seams = Seams::Welded);

/// Adds back faces to two-sided sheets: in each connected piece with a boundary, a copy of each two-sided triangle with
/// reversed orientation, offset by 1e-5 of the mesh's diagonal so that welding does not join it. Closed pieces need no
/// back. `two_sided` has one entry for each triangle. Returns the number of triangles added.
std::size_t add_back_faces(TriangleMesh& mesh, const std::vector<bool>& two_sided);

/// Returns for each used vertex the index of the first used vertex with the same position and colour, bit for bit (-0
/// equals 0); invalid_index for unused vertices. `colours` may be empty.
std::vector<std::uint32_t> first_duplicates(
    std::span<const glm::dvec3> vertices_m, std::span<const glm::vec3> colours, const std::vector<bool>& used);

} // namespace octant::models::repair
