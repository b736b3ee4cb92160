#pragma once

#include "models/simplify/paper_mesh.h"
#include "models/simplify/point6.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace octant::models::simplify {

/// How many perpendiculars were dropped on triangles, and how many feet lay outside: the last
/// column of the paper's table.
struct FeetCount {
    std::size_t all = 0;
    std::size_t outside = 0;
};

/// An edge that is about to be contracted, with the faces at either of its ends, each once.
struct Contraction {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    std::span<const std::uint32_t> faces;
};

/// The sum of the squared distances from the new vertex to the faces of the mesh before the
/// contraction, M_(i-1).
double cost_there(
    const PaperMesh& mesh, const Contraction& edge, const Point6& candidate, FeetCount& feet);

/// The sum of the squared distances from both old vertices to the faces of the mesh after the
/// contraction, M_i, the collapsed ones included.
double
cost_back(const PaperMesh& mesh, const Contraction& edge, const Point6& candidate, FeetCount& feet);

} // namespace octant::models::simplify
