#pragma once

#include "models/polygons/polygon_model.h"

#include <cstddef>
#include <filesystem>
#include <span>

namespace octant::models::polygons {

/// How many polygons of a file are named in PolygonModel::notes; one more note counts the others.
inline constexpr std::size_t max_notes_of_cuts = 10;

/// Makes all polygons of a model that was read from a file convex and planar within
/// flatness_tolerance_m. A dented or bent one is replaced, where it stands, by its convex_pieces;
/// then model.parents is filled and model.notes says "file:line: polygon of N corners is
/// dented|bent: cut into K". One that meets itself, as around a hole, becomes triangles by
/// triangulate_polygon, one without an area is left out; corners in the place of the one before do not
/// count. Notes say so. `lines` are the polygons' lines in the file.
///
/// Throws Error "file: expected ..., got ..." when no polygon is left.
void triangulate_faulty_polygons(
    PolygonModel& model, const std::filesystem::path& path, std::span<const int> lines);

} // namespace octant::models::polygons
