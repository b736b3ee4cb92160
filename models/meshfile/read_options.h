#pragma once

#include "models/meshfile/affine_transform.h"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace octant::models::meshfile {

/// How a mesh is read.
struct ReadOptions {
    /// The pictures on surfaces of .ac, .obj and glTF files are read too, and give the vertices their colours: the mean
    /// around each, times its material's. Of a mesh whose vertices have colours of their own they are left out.
    /// Triangles on which the picture is mostly transparent (shadows on the ground, turning propellers, clear glass)
    /// are left out, unless all are.
    bool pictures = false;
    /// Where pictures are looked for before the mesh's own folder; empty: there alone.
    std::filesystem::path pictures_in = {};
    /// Sheets that .ac and glTF files call two-sided get backs (sheet_backs.h).
    bool backs = false;
    /// Objects of .ac files that by their names stand for what is no surface (discs of turning blades, cones of light,
    /// shadows on the ground) are read like others. They are in any case if there is nothing else.
    bool placeholders = true;
    /// Objects of .ac files that are left out, by their names, with what hangs on them.
    std::set<std::string> excluded = {};
    /// Where objects of .ac files are moved to, by their names, with what hangs on them; axes of the file. What moves
    /// an object moves those that hang on it after they were moved themselves.
    std::map<std::string, AffineTransform> moved = {};
    /// Objects of .ac files that read_parts gives apart, by their names, with what hangs on them: of nested ones the
    /// outermost counts, of several groups the first.
    std::vector<std::set<std::string>> groups = {};
};

} // namespace octant::models::meshfile
