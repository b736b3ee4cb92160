#pragma once

#include "models/polygons/file_axes.h"
#include "models/triangle_mesh.h"

#include <optional>

namespace octant::models::polygons {

/// Where nose and top of an aircraft lie in a mesh in its file's axes, by its shape: it is the same left and right,
/// longer than it is high, and has its fin at the tail. Nothing where the shape does not say so clearly. Time goes with
/// the triangles, and a grid of at most 64 cells a side.
std::optional<FileAxes> guess_axes(const TriangleMesh& mesh);

} // namespace octant::models::polygons
