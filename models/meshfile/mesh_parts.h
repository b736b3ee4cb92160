#pragma once

#include "models/meshfile/read_options.h"
#include "models/triangle_mesh.h"

#include <filesystem>
#include <vector>

namespace octant::models::meshfile {

/// Surfaces of materials or pictures through which what lies behind is seen: the glass of canopies.
struct TransparentSurfaces {
    TriangleMesh mesh;    ///< often without a triangle
    float opacity = 1.0F; ///< mean of their materials: how much they hide, above 0 and below 1
};

/// A mesh with its parts apart. Any of them may be without a triangle.
struct MeshParts {
    TriangleMesh body;                ///< has the notes on all of them
    std::vector<TriangleMesh> groups; ///< those of the options
    TransparentSurfaces clear;
};

/// As read_mesh, in one reading of the file, with what is clear (of .ac, .obj and glTF files) and groups of objects (of
/// .ac files) apart. With pictures what they cover evenly by 0.05 to 0.5 is clear, too. Invisible surfaces are left
/// out, and so are parts whose picture is mostly transparent otherwise. Throws Error.
MeshParts read_parts(const std::filesystem::path& path, const ReadOptions& options);

} // namespace octant::models::meshfile
