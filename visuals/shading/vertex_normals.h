#pragma once

#include "models/polygons/polygon_model.h"
#include "models/smooth_normals.h"
#include "models/triangle_mesh.h"

#include <glm/vec2.hpp>
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

/// Texture coordinates for the corners of such pieces, from those of the whole polygons, which have one for each corner
/// (asserted): linear along sides, by mean value coordinates inside. Not numbers (NaN) where a whole polygon has none.
std::vector<glm::vec2> piece_texture_coordinates(
    const models::polygons::PolygonModel& whole, const models::polygons::PolygonModel& pieces);

/// Returns a unit normal for each corner, in the order of PolygonModel::corner_vertices: the one that the model's file
/// gives or, where it gives none, the mean of the face normals around the corner's vertex, each weighted by the face's
/// angle there. Only those faces count that can be reached from the corner's own face across edges at that vertex and
/// whose normals are within the crease angle (0 to pi, asserted) of its own.
///
/// Vertices at exactly the same position count as one. Faces that turn about different pivots, or of which one is
/// fixed, do not mix. Meant for loading: the time grows with the square of the number of faces around one vertex.
std::vector<glm::vec3> corner_normals(
    const models::polygons::PolygonModel& model, double crease_rad = models::default_crease_rad);

/// The same for a triangle mesh, three normals for each triangle. Triangles without area contribute nothing. The
/// normals that the mesh's file brought along are ignored.
std::vector<glm::vec3> corner_normals(const models::TriangleMesh& mesh, double crease_rad = models::default_crease_rad);

} // namespace octant::visuals::shading
