#include "models/meshfile/mesh_parts.h"

#include <utility>

namespace octant::models::meshfile {

void add_clear(TransparentSurfaces& to, TransparentSurfaces from, const AffineTransform& placement) {
    const std::size_t count = from.mesh.triangles.size();
    if (count == 0) { return; }
    const bool is_first = to.mesh.triangles.empty();
    join_mesh(to.mesh, std::move(from.mesh), placement);
    const float share = static_cast<float>(count) / static_cast<float>(to.mesh.triangles.size());
    to.opacity = is_first ? from.opacity : to.opacity + (from.opacity - to.opacity) * share;
}

TriangleMesh mesh_at_rest(RotatingModel model) {
    for (RotatingPart& part : model.parts) {
        if (is_shown_at_rest(part.moves)) { join_mesh(model.body, std::move(part.mesh), {}); }
    }
    join_mesh(model.body, std::move(model.clear.mesh), {});
    return std::move(model.body);
}

} // namespace octant::models::meshfile
