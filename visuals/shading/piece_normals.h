#pragma once

#include "models/polygons/polygon_model.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace octant::visuals::shading {

/// Corner normals of a model whose polygons were cut into pieces (for a draw order), so that the
/// pieces together look like the polygons they were: a corner that a polygon had before has the
/// same normal, one on a side what lies between the side's ends, one inside what lies between all
/// corners. `whole`: the model before it was cut, `normals`: one a corner of it. The parents of
/// `pieces` are those of `whole`. As many normals as `pieces` has corners.
std::vector<glm::vec3> normals_of_pieces(
    const models::polygons::PolygonModel& whole,
    std::span<const glm::vec3> normals,
    const models::polygons::PolygonModel& pieces);

} // namespace octant::visuals::shading
