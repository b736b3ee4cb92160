#pragma once

#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"

namespace octant::models::polygons {

/// A mesh's triangles as polygons: one part, and one material for all colours that differ by less than 1/31.
PolygonModel polygons_from_mesh(const TriangleMesh& mesh);

/// The polygons cut into fans, without colours: what their distance is measured by.
TriangleMesh mesh_from_polygons(const PolygonModel& polygons);

} // namespace octant::models::polygons
