#pragma once

#include "models/polygons/file_axes.h"

#include <filesystem>
#include <optional>

namespace octant::models::meshfile {

/// How aircraft lie in files of a format, by the file's ending: in AC3D files as FlightGear has them (x back, y up, z
/// left), in its models (.xml) x back, y right, z up, in glTF files as its specification says (x left, y up, z
/// forward). Nothing for formats that prescribe nothing.
std::optional<polygons::FileAxes> axes_of_format(const std::filesystem::path& file);

/// How scenes of a format that says which way is up mostly lie: in OpenFlight's and OpenSceneGraph's files x right, y
/// forward, z up. Nothing for others.
std::optional<polygons::FileAxes> default_axes_of_format(const std::filesystem::path& file);

} // namespace octant::models::meshfile
