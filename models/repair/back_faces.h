#pragma once

#include "models/triangle_mesh.h"

#include <cstddef>
#include <vector>

namespace octant::models::repair {

/// Gives two-sided sheets a back: of each connected piece that is open, each two-sided triangle turned round, a
/// hundred-thousandth of the mesh's diagonal behind, so that welding keeps it apart. Closed pieces are never seen from
/// behind. `two_sided`: one a triangle. Returns how many were added.
std::size_t add_back_faces(TriangleMesh& mesh, const std::vector<bool>& two_sided);

} // namespace octant::models::repair
