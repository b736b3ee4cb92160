#pragma once

#include "models/triangle_mesh.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::studies::simplification {

/// A mesh of the simplification study.
struct StudyMesh {
    std::string name;
    models::TriangleMesh original; ///< as read or made
    models::TriangleMesh clean;    ///< repaired, without materials and normals
    double diagonal_m = 0.0;
};

/// The Stanford bunny as the paper used it. Throws Error for a file with other numbers of vertices
/// and faces.
StudyMesh bunny_from(const std::filesystem::path& file);

/// A mesh from a file. Throws Error.
StudyMesh study_mesh_from(const std::filesystem::path& file);

/// The coloured globe, a torus of 32,768 triangles, and what has sharp edges: a machined part, and
/// the F-15 with every triangle cut in four until there are 40,000.
std::vector<StudyMesh> built_in_mesh_names();

/// The same mesh without the colours of its vertices.
StudyMesh uncoloured(StudyMesh mesh);

} // namespace octant::ui::studies::simplification
