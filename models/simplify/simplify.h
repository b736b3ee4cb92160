#pragma once

#include "models/collapse_sequence.h"
#include "models/simplify/simplify_options.h"
#include "models/triangle_mesh.h"

namespace octant::models::simplify {

struct Simplified {
    TriangleMesh mesh;         ///< after the last polish; with the original's materials and normals
    CollapseSequence sequence; ///< what led there, without the polish
};

/// Simplifies an oriented manifold (RepairedMesh; asserted). A closed manifold stays a closed
/// manifold of the same genus, boundaries and creases are kept. The same input gives the same
/// bytes.
Simplified simplified(TriangleMesh original, const SimplifyOptions& options);

/// The sequence of Quality::Fast alone, without a polish. For that quality and a goal without an
/// error (asserted).
CollapseSequence fast_sequence(TriangleMesh original, const SimplifyOptions& options);

/// Moves vertices and flips edges of a mesh for a smaller distance to the original, both ways: what
/// simplified() ends with.
TriangleMesh
polished(TriangleMesh mesh, const TriangleMesh& original, const SimplifyOptions& options);

} // namespace octant::models::simplify
