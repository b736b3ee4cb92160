#pragma once

#include "models/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace octant::models::repair {

/// Rims of a mesh that touch but for rounding: for each vertex on an edge of one triangle only the
/// first such one within a millionth of the mesh's diagonal, perhaps itself, where welding it
/// makes no triangle's corners one. Itself for all other vertices.
std::vector<std::uint32_t> close_boundaries(const TriangleMesh& mesh);

} // namespace octant::models::repair
