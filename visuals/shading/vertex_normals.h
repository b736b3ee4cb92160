#pragma once

#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"
#include "sim/base/units.h"

#include <glm/vec3.hpp>

#include <vector>

namespace octant::visuals::shading {

/// Faces that meet at a larger angle than this keep an edge between them.
inline constexpr double default_crease_rad = rad_from_deg(40.0);

/// A unit normal for each corner, in the order of PolygonModel::corner_vertices: the mean of the
/// faces around the corner's vertex, weighted by their angles there, that can be reached from the
/// corner's own face across edges at that vertex and whose normals are within the crease angle (0
/// to pi) of its own. Vertices in exactly the same place count as one; faces that turn about
/// different pivots, or of which one is fixed, do not mix. Work for loading: it grows with the
/// square of the faces around one vertex.
std::vector<glm::vec3>
corner_normals(const models::polygons::PolygonModel& model, double crease_rad = default_crease_rad);

/// The same for a mesh, three a triangle; triangles without area count nowhere. Normals of the
/// mesh's own file are not looked at.
std::vector<glm::vec3>
corner_normals(const models::TriangleMesh& mesh, double crease_rad = default_crease_rad);

} // namespace octant::visuals::shading
