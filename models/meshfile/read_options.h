#pragma once

#include <set>
#include <string>

namespace octant::models::meshfile {

/// How a mesh is read.
struct ReadOptions {
    /// The pictures on surfaces of .ac, .obj and glTF files are read too, and give the vertices
    /// their colours: the mean around each, times its material's. Of a mesh whose vertices have
    /// colours of their own they are left out. Triangles on which the picture is mostly transparent
    /// (shadows on the ground, turning propellers, clear glass) are left out, unless all are.
    bool pictures = false;
    /// Sheets that .ac and glTF files call two-sided get backs (sheet_backs.h).
    bool backs = false;
    /// The mesh is a part of a larger one: with `pictures`, Error is thrown where all of it is
    /// mostly transparent.
    bool is_part = false;
    /// Objects of .ac files that are left out, by their names, with what hangs on them.
    std::set<std::string> left_out = {};
    /// Objects of .ac files that alone are read, by their names, with what hangs on them; none:
    /// all are.
    std::set<std::string> only = {};
};

} // namespace octant::models::meshfile
