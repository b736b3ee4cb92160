#pragma once

#include "models/heights/height_field.h"

#include <filesystem>

namespace octant::models::heights {

/// Writes a GeoTIFF that read_height_field reads back exactly: size, spacing and every height but a common void mark
/// (height_voids.h) that lies far from all other heights. It has 32-bit floats, deflate, the field's centre at the
/// origin. A field with a place gets the transverse Mercator system that touches its ellipsoid there, one without gets
/// a local system in metres. `filled_voids` and `name` are not kept. The file is written whole or not at all. Throws
/// Error (no permission, no such folder, disk full).
void write_height_field(const std::filesystem::path& path, const HeightField& field);

} // namespace octant::models::heights
