#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"

#include <filesystem>

namespace octant::models::polygons {

/// Reads a Wavefront OBJ file of polygons, coordinates in metres in the file's `axes`. Dented and bent polygons are cut
/// into convex planar ones (obj_polygons.h), which PolygonModel::parents and PolygonModel::notes say.
///
/// Read: v (what follows three coordinates is ignored), f (n-gons; corners as 7, 7/1, 7//3 or 7/1/3; negative numbers
/// count back from the last vertex), g and o (parts; polygons before the first belong to "default"), usemtl ("default"
/// before the first), mtllib (files beside the OBJ file: one whose name may have blanks, or several), and comments of
/// the form
///     # pivot NAME X Y Z axis AX AY AZ [rpm N]
/// which say that part NAME turns about the axis through a point, N times a minute in flight (0 where it is not said;
/// obj_pivots.h). The other keywords of the OBJ specification (s, l, p, vt, vn, vp, curves and surfaces, attributes,
/// calls) and other comments are ignored, those that it calls superseded (bsp, bzp, cdc, cdp, res) with a note. A
/// backslash at the end of a line joins the next one to it (obj_lines.h); messages then name the line where it begins.
/// A UTF-8 byte order mark is skipped.
///
/// Vertices stay in file order, also unused ones; parts and materials come in the order of their first polygon. A file
/// without mtllib keeps its material names, all in the default colour. So do materials that no file knows when a
/// material file is missing, which PolygonModel::notes says.
///
/// Polygons without an area are left out, those whose sides meet become triangles, with a note.
///
/// Throws Error "file:line: expected ..., got ..." for anything else: other keywords, numbers that cannot be read, NaN
/// and infinity, indices out of range, a material that none of the material files knows although all are there, a pivot
/// of a part without polygons or without an axis, more than obj_limits.h allows; "file: ..." for binary data and a file
/// without polygons.
PolygonModel read_obj(const std::filesystem::path& path, const FileAxes& axes = {});

} // namespace octant::models::polygons
