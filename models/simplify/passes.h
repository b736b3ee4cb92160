#pragma once

#include "models/simplify/revisions.h"
#include "models/simplify/simplified.h"

#include <functional>

namespace octant::models::simplify {

/// One pass: collapses chosen as `chosen_by` says until the goal of vertices or faces is met or no
/// edge can collapse any more, then a polish as the options' quality says.
using OnePass = std::function<Simplified(
    TriangleMesh original, const SimplifyOptions& options, Chooser chosen_by)>;

/// What best_of_passes tries.
struct Ways {
    OnePass one_pass;
    Revise revise;
};

/// The best of several passes: with Quality::Surface plain ones by quadrics and volumes are tried
/// too, where few faces are to be left and they cost little, and with Quality::Fast the one by
/// volumes, where the mesh is small, and on small meshes the one by planes, which the result should
/// not be beaten by. On small meshes Quality::Surface then tries passes that fit slivers, where a
/// plain one is better than the best in one value, passes that avoid the largest distance of the
/// best, and revisions, where the mesh has no colours; borders of materials stay where they are.
/// Where a goal is out of reach shells go, unless the options keep them: the smallest ones or those
/// nearest to others, by a plain pass each.
Simplified best_of_passes(TriangleMesh original, const SimplifyOptions& options, const Ways& ways);

} // namespace octant::models::simplify
