#pragma once

#include "models/meshfile/rotating_model.h"
#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"

#include <span>

namespace octant::ui::world {

/// Turns a mesh from its file's axes into body axes: a rotation, so that no triangle turns over.
void rotate_mesh_to_body(models::TriangleMesh& mesh, const models::polygons::FileAxes& axes);

/// Turns a part with its axis from its file's axes into body axes.
void rotate_part_to_body(models::meshfile::RotatingPart& part, const models::polygons::FileAxes& axes);

/// Adds parts that turn to the polygons that stand in for an aircraft far away: a pivot for each,
/// in their order, and as few triangles as a part far away needs. Body axes. Returns the largest
/// certified distance, in metres, between a part and its polygons.
double add_far_parts(
    std::span<const models::meshfile::RotatingPart> parts, models::polygons::PolygonModel& polygons);

/// Adds clear surfaces to them, opaque: far away what lies behind is not seen. Returns the same.
double add_far_transparent(const models::TriangleMesh& mesh, models::polygons::PolygonModel& polygons);

} // namespace octant::ui::world
