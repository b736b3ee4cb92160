#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace octant::models::polygons {

// Limits of OBJ files of polygons. The reader refuses larger files.
inline constexpr std::size_t max_obj_vertices = 1'000'000;
inline constexpr std::size_t max_obj_polygons = 1'000'000;
inline constexpr std::size_t max_obj_corners_of_polygon = 1'000;
inline constexpr double max_obj_coordinate_m = 1e7;

/// A picture of a material in an MTL file, such as `map_Kd -clamp on FILE`.
struct MtlPicture {
    std::string file;
    bool is_clamped = false; ///< -clamp on
    bool is_moved = false;   ///< -o, -s or -t, which are not read
};

/// What an MTL file says about its materials.
struct MtlFile {
    /// `newmtl NAME`, its `Kd R G B` as display values, its opacity, `d`, else 1 - `Tr`, and whether it is a mirror,
    /// `illum 5` or `7` (reflection with Fresnel's law); in file order.
    std::vector<Material> materials;
    std::vector<std::pair<std::string, MtlPicture>> pictures;           ///< material and `map_Kd`, in file order
    std::vector<std::pair<std::string, std::string>> emissive_pictures; ///< material and the file of `map_Ke`
    std::map<std::string, int> undrawn_pictures; ///< how many, by what they are for: normals, highlights, glow, opacity
    std::vector<std::string> notes;              ///< what was left out, "file:line: ..."
};

/// Reads an MTL file. A material without Kd has the default colour. Ignores other lines, and what follows a word that
/// begins with # behind numbers. Leaves out, with one note for each kind in a file: opacities outside 0..1, unreadable
/// ones, of several numbers or with -halo, a Tr of 1 without a d, whose meaning differs between programs, and an illum
/// that is not one whole number 0..10. A word after a dash that is no option of a picture begins its name, with a note.
/// Throws Error "file:line: expected ..., got ..." for a Kd that is not three numbers 0..1, an illum that does not
/// begin as a number, any of these before the first newmtl, for a name that is missing or comes twice, and for a file
/// that is not text.
MtlFile read_mtl(const std::filesystem::path& path);

/// Reads a Wavefront OBJ file of polygons, coordinates in metres in the file's `axes`. Concave and bent polygons are
/// cut into convex planar ones, recorded in PolygonModel::parents and PolygonModel::notes.
///
/// Read: v (values after three coordinates are ignored), f (n-gons; corners as 7, 7/1, 7//3 or 7/1/3; negative numbers
/// count back from the last vertex), g and o (parts; polygons before the first belong to "default"), usemtl ("default"
/// before the first), mtllib (files in the folder of the OBJ file: one whose name may contain blanks, or several), and
/// comments of the form
///     # pivot NAME X Y Z axis AX AY AZ [rpm N]
/// for a part NAME that rotates about an axis through a point, N turns per minute in flight (default 0). The other
/// keywords of the OBJ specification (s, l, p, vt, vn, vp, curves and surfaces, attributes, calls) and other comments
/// are ignored, superseded ones (bsp, bzp, cdc, cdp, res) with a note. A backslash at
/// the end of a line joins the next line, except in a comment, which may end with a path.
///
/// All vertices are kept in file order; parts and materials are in the order of their first polygon. Without mtllib,
/// all materials have the default colour. If a material file is missing, unknown materials have the default colour,
/// with a note. Polygons without an area are left out and self-intersecting polygons become triangles, with a note.
/// Polygons of a material that is not seen (seen_from_opacity) are left out with a note, unless all are of such.
///
/// Throws Error "file:line: expected ..., got ..." for anything else: other keywords, numbers that cannot be read, NaN
/// and infinity, indices out of range, a material that no material file defines although all files exist, a
/// pivot of a part without polygons, a pivot without an axis, more than the limits above; "file: ..." for binary data
/// and a file without polygons.
///
/// With `textures`, corners keep their texture coordinates (vt) and materials name the picture of map_Kd as the file
/// does, without decoding it; polygons without a picture, or with a corner that has no coordinates, have none.
PolygonModel read_obj(const std::filesystem::path& path, const FileAxes& axes = {}, bool textures = false);

} // namespace octant::models::polygons
