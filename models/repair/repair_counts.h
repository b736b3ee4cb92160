#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace octant::models::repair {

/// What was found and mended in a mesh.
struct RepairCounts {
    std::size_t unreferenced_vertices = 0; ///< taken out, also what the triangles below leave
    std::size_t duplicate_vertices = 0; ///< welded: one place (-0 is 0), or rims that nearly touch
    std::size_t degenerate_triangles = 0; ///< two corners in one vertex, or no area: taken out
    /// Taken out: the same three vertices again, where no closed shell needs them.
    std::size_t duplicate_triangles = 0;
    std::size_t flipped_triangles = 0; ///< turned to agree with their neighbours
    std::size_t split_edges = 0;    ///< shared by more than two triangles, or by two that disagree
    std::size_t split_vertices = 0; ///< where several fans met: each got a vertex of its own
    std::size_t boundary_loops = 0; ///< holes; carried through
    std::size_t shells = 0;         ///< connected pieces

    bool operator==(const RepairCounts&) const = default;
};

/// One line each for what was found, in words a user reads; empty for a closed mesh without faults.
std::vector<std::string> describe_counts(const RepairCounts& counts);

} // namespace octant::models::repair
