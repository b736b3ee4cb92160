#pragma once

#include "models/collapse_sequence.h"
#include "models/simplify/simplified.h"
#include "models/simplify/simplify_options.h"
#include "models/triangle_mesh.h"

namespace octant::models::simplify {

/// Simplifies an oriented manifold (a RepairedMesh; asserted). A closed manifold stays a closed
/// manifold of the same genus, unless shells go for a goal of vertices or faces that cannot be
/// reached with all of them; boundaries and creases are kept. The same input gives the same bytes
/// on any number of threads. Lengths are in metres.
Simplified simplified(TriangleMesh original, const SimplifyOptions& options);

/// The collapse sequence of Quality::Fast alone, without a polish. The options must have that
/// quality and a goal without an error (asserted).
CollapseSequence fast_sequence(TriangleMesh original, const SimplifyOptions& options);

/// Moves vertices and flips edges of a mesh so that its distance to the original gets smaller, both
/// ways: the last step of simplified().
TriangleMesh
polished(TriangleMesh mesh, const TriangleMesh& original, const SimplifyOptions& options);

} // namespace octant::models::simplify
