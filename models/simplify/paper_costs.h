#pragma once

#include "models/simplify/paper_mesh.h"
#include "models/simplify/point6.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace octant::models::simplify {

/// Perpendiculars that were dropped.
struct FeetCount {
    std::size_t all = 0;
    std::size_t outside = 0;
};

/// An edge that is about to be contracted, and the faces at its ends, each once.
struct Contraction {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    std::span<const std::uint32_t> faces;
};

/// Sum of the squared distances of the new vertex to the faces of the mesh before.
double cost_there(
    const PaperMesh& mesh, const Contraction& edge, const Point6& candidate, FeetCount& feet);

/// Sum of the squared distances of both old vertices to the faces of the mesh after, collapsed ones
/// too.
double
cost_back(const PaperMesh& mesh, const Contraction& edge, const Point6& candidate, FeetCount& feet);

} // namespace octant::models::simplify
