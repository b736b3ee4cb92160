#include "models/meshfile/mesh_parts.h"

#include <utility>

namespace octant::models::meshfile {

TriangleMesh mesh_at_rest(RotatingModel model) {
    for (RotatingPart& part : model.parts) {
        if (is_shown_at_rest(part.moves)) { join_mesh(model.body, std::move(part.mesh), {}); }
    }
    join_mesh(model.body, std::move(model.clear), {});
    return std::move(model.body);
}

} // namespace octant::models::meshfile
