#pragma once

#include "models/polygons/polygon_model.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <span>

namespace octant::models::planar {

/// Axes that turn with a model, as the columns of a rotation: the first is the side of a polygon
/// along or across which most of the length of all sides lies, the second the best one across it.
/// Of a model that is built along its file's axes they are these, in some order. What turns is left
/// out. `points` are the vertices in any unit.
glm::dmat3 own_axes(const polygons::PolygonModel& model, std::span<const glm::dvec3> points);

} // namespace octant::models::planar
