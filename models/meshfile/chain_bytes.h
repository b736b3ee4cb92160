#pragma once

#include "models/meshfile/byte_reader.h"
#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"

#include <string>

namespace octant::models::meshfile {

/// How chains hold meshes and models: each list behind its 64-bit count, numbers little endian as
/// they are in memory, so that nothing is rounded.
void append_mesh(std::string& bytes, const TriangleMesh& mesh);
void append_model(std::string& bytes, const polygons::PolygonModel& model);
void append_text(std::string& bytes, const std::string& text);

/// Throw Error "file: at byte N: ..." for what the file cannot hold, indices out of range, numbers
/// that are not finite, and what is not as TriangleMesh and PolygonModel say.
TriangleMesh take_mesh(ByteReader& reader);
polygons::PolygonModel take_model(ByteReader& reader);
std::string take_text(ByteReader& reader);

} // namespace octant::models::meshfile
