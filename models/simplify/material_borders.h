#pragma once

#include "models/triangle_mesh.h"

namespace octant::models::simplify {

/// How far the borders of materials of a mesh are from those of its original.
struct BorderDistance {
    double most_m = 0.0; ///< From the mesh to the original; what has vanished is not seen.
    double rms_m = 0.0; ///< The larger one of both ways, where what is far away counts as less far.

    /// Whether it is hardly more than another one.
    bool keeps(const BorderDistance& other) const;
};

/// Whether triangles of a mesh have different materials.
bool has_material_borders(const TriangleMesh& mesh);

/// From samples. Nothing where neither has borders, and infinite where only one has.
BorderDistance material_border_distance(const TriangleMesh& mesh, const TriangleMesh& original);

} // namespace octant::models::simplify
