#pragma once

#include "models/collapse_sequence.h"
#include "models/simplify/simplify_options.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <functional>

namespace octant::models::simplify {

/// Makes the finished mesh (optimized, with normals) after so many collapses of a sequence.
using MeshAfter = std::function<TriangleMesh(std::size_t collapses)>;

struct KeptError {
    std::size_t collapses = 0;
    /// The finished mesh after that many.
    TriangleMesh mesh;
};

/// Searches for the most collapses whose finished mesh keeps the wanted error
/// (options.goal.error_m, which must be there) by its certified distance, so that whoever measures
/// it again with the usual tightness finds it kept. Each try makes a mesh and measures it.
KeptError max_collapses_within(
    const CollapseSequence& sequence,
    const SimplifyOptions& options,
    const MeshAfter& finished_after);

} // namespace octant::models::simplify
