#pragma once

#include "models/collapse_sequence.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::models::simplify {

/// The connected pieces of a mesh.
struct Shells {
    std::vector<std::uint32_t> of_triangle; ///< the number of its shell
    std::vector<double> sizes_m;            ///< diagonals of their bounding boxes
};

Shells shells_of(const TriangleMesh& mesh);

/// Which shells of a mesh may stay so that it gets down to `faces`, in some ways: the
/// largest ones, or the largest and then whichever is farthest from those that stay, as long as
/// there is room for the triangles that the collapses left of each, with less or more to spare.
/// Of very many shells the largest ones alone. `exhausted`: collapses of the mesh until none was
/// possible any more.
std::vector<std::vector<bool>>
shells_that_may_stay(const Shells& shells, const CollapseSequence& exhausted, std::size_t faces);

/// The mesh with the triangles of some shells alone, in their order; vertices in the order of their
/// first corners.
TriangleMesh
only_shells(const TriangleMesh& mesh, const Shells& shells, const std::vector<bool>& stays);

} // namespace octant::models::simplify
