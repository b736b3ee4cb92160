#pragma once

#include "models/polygons/polygon_model.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace octant::visuals::shading {

/// Corner normals for a model whose polygons were cut into pieces (a draw order may need that), chosen so that the
/// pieces together are shaded as the whole polygons were. A corner of a piece that coincides with a corner of its
/// polygon gets that normal; a corner on a side gets the linear mixture of the side's two ends; a corner inside gets a
/// mixture of all corners by mean value coordinates.
///
/// `whole` is the model before it was cut and `normals` has one unit normal for each of its corners (asserted). The
/// parents of `pieces` are the polygons of `whole`. Returns one unit normal for each corner of `pieces`.
std::vector<glm::vec3> piece_normals(const models::polygons::PolygonModel& whole, std::span<const glm::vec3> normals,
    const models::polygons::PolygonModel& pieces);

} // namespace octant::visuals::shading
