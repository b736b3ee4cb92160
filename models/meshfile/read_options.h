#pragma once

#include <set>
#include <string>

namespace octant::models::meshfile {

/// How a mesh is read.
struct ReadOptions {
    /// The pictures on surfaces of .ac, .obj and glTF files are read too, and give the vertices
    /// their colours: the mean around each, times its material's. Of a mesh whose vertices have
    /// colours of their own they are left out.
    bool pictures = false;
    /// Sheets that .ac and glTF files call two-sided get backs (sheet_backs.h).
    bool backs = false;
    /// Objects of .ac files that are left out, by their names, with what hangs on them.
    std::set<std::string> left_out = {};
};

} // namespace octant::models::meshfile
