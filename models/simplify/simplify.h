#pragma once

#include "models/collapse_sequence.h"
#include "models/measure/triangle_bvh.h"
#include "models/simplify/simplify_options.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <memory>

namespace octant::models::simplify {

/// The result of a simplification.
struct Simplified {
    TriangleMesh mesh; ///< the optimized mesh with the original's materials
    /// The collapses before the optimization; none if shells were dropped or handles cut, or with an error limit.
    CollapseSequence sequence;
    std::size_t shells_removed = 0;
    std::size_t holes_closed = 0;
    std::size_t handles_cut = 0;
    std::size_t steps = 0; ///< number of steps of all optimizations
    /// A tree over the original's triangles; null if none was built.
    std::shared_ptr<const measure::TriangleBvh> original_tree{};
    double collapse_cpu_s = 0.0;
    double optimize_cpu_s = 0.0;
};

/// Simplifies an oriented manifold (a RepairedMesh; asserted): edge collapses, then an optimization. The result is an
/// oriented manifold without triangles that fold over. Unless the options forbid it, shells are dropped, holes closed
/// and handles cut when that is the cheapest step. The same input gives the same bytes on any number of threads.
/// Lengths are in metres.
Simplified simplified(const TriangleMesh& original, const SimplifyOptions& options);

/// The collapse sequence by quadrics only, without changes of the topology. The goal must not be an error (asserted).
CollapseSequence fast_sequence(TriangleMesh original, const SimplifyOptions& options);

/// Optimizes a simplified mesh: the last step of simplified().
TriangleMesh optimized(const TriangleMesh& mesh, const TriangleMesh& original, const SimplifyOptions& options);

} // namespace octant::models::simplify
