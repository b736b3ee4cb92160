#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::polygons {

// Limits of OBJ files of polygons. The reader refuses larger files.
inline constexpr std::size_t max_obj_vertices = 1'000'000;
inline constexpr std::size_t max_obj_polygons = 1'000'000;
inline constexpr std::size_t max_obj_corners_of_polygon = 1'000;
inline constexpr double max_obj_coordinate_m = 1e7;

/// Returns the text without the UTF-8 byte order mark (EF BB BF) that it may begin with.
std::string_view without_byte_order_mark(std::string_view text);

/// Splits an OBJ text into lines. A backslash at the end of a line joins it to the next line with a blank, except in a
/// comment, which may end with a path. Skips a byte order mark.
class ObjLineReader {
public:
    /// Keeps views into `text`.
    explicit ObjLineReader(std::string_view text);

    /// Advances to the next line; false if there is none.
    bool next();

    /// The current line; valid until the next call of next().
    std::string_view text() const { return text_; }

    /// The number of the line in the file, from 1; of joined lines the first.
    int number() const { return number_; }

private:
    std::string_view next_line();

    std::string_view rest_; ///< the text after the current line
    std::string joined_;
    std::string_view text_;
    int number_ = 0;
    int lines_ = 0; ///< read so far
};

/// Returns a view of the text after the first word of a line, without blanks at either end. Names in OBJ and MTL files
/// may contain blanks.
std::string_view after_first_word(std::string_view line);

/// Reads the materials of an MTL file in file order: `newmtl NAME` and its `Kd R G B`, used as display values. A
/// material without Kd has the default colour. All other lines are ignored. Throws Error "file:line: expected ..., got
/// ..." for a Kd that is not three numbers 0..1 or that comes before any newmtl, for a name that is missing or comes
/// twice, and for a file that is not text.
std::vector<Material> read_mtl(const std::filesystem::path& path);

/// Reads the picture of each material of an MTL file by material name: the last word of `map_Kd ... FILE`.
/// Throws Error for a file that is not text.
std::map<std::string, std::string> pictures_of_mtl(const std::filesystem::path& path);

/// Reads the opacities below 1 of an MTL file's materials by material name: `d`, else 1 - `Tr`. Ignores values outside
/// 0..1 and a Tr of 1, whose meaning differs between programs. Throws Error for a file that is not text.
std::map<std::string, float> opacities_of_mtl(const std::filesystem::path& path);

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
/// are ignored, superseded ones (bsp, bzp, cdc, cdp, res) with a note. See ObjLineReader for joined lines.
///
/// All vertices are kept in file order; parts and materials are in the order of their first polygon. Without mtllib,
/// all materials have the default colour. If a material file is missing, unknown materials have the default colour,
/// with a note. Polygons without an area are left out and self-intersecting polygons become triangles, with a note.
///
/// Throws Error "file:line: expected ..., got ..." for anything else: other keywords, numbers that cannot be read, NaN
/// and infinity, indices out of range, a material that no material file defines although all files exist, a
/// pivot of a part without polygons, a pivot without an axis, more than the limits above; "file: ..." for binary data
/// and a file without polygons.
PolygonModel read_obj(const std::filesystem::path& path, const FileAxes& axes = {});

} // namespace octant::models::polygons
