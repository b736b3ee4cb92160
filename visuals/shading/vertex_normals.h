#pragma once

#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"
#include "sim/base/units.h"

#include <glm/vec3.hpp>

#include <vector>

namespace octant::visuals::shading {

/// Faces that meet at a larger angle than this keep a visible crease between them.
inline constexpr double default_crease_rad = rad_from_deg(40.0);

/// Computes a unit normal for each corner, in the order of PolygonModel::corner_vertices. It is the mean of the face
/// normals around the corner's vertex, each weighted by the face's angle there. Only those faces count that can be
/// reached from the corner's own face across edges at that vertex and whose normals are within the crease angle (0 to
/// pi, asserted) of its own.
///
/// Vertices at exactly the same position count as one. Faces that turn about different pivots, or of which one is
/// fixed, do not mix. Meant for loading: the time grows with the square of the number of faces around one vertex.
std::vector<glm::vec3> corner_normals(
    const models::polygons::PolygonModel& model, double crease_rad = default_crease_rad);

/// The same for a triangle mesh, three normals for each triangle. Triangles without area contribute nothing. The
/// normals that the mesh's file brought along are ignored.
std::vector<glm::vec3> corner_normals(const models::TriangleMesh& mesh, double crease_rad = default_crease_rad);

} // namespace octant::visuals::shading
