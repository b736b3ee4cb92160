#pragma once

#include "models/measure/mesh_defects.h"
#include "models/measure/mesh_distance.h"
#include "models/simplify/paper_simplify.h"
#include "models/triangle_mesh.h"
#include "ui/base/output_options.h"
#include "ui/base/progress.h"

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

/// The Stanford bunny as the paper used it. Throws Error for a file with other numbers of vertices and faces.
StudyMesh bunny_from(const std::filesystem::path& file);

/// Counted vertices that the paper stops at.
inline constexpr std::size_t paper_bunny_vertices = 2000;

/// What counts besides position.
enum class ColourReading { None, Distance, DistanceAndLength };

/// One run of the paper's simplifier.
struct PaperRun {
    std::string mesh;
    ColourReading colour = ColourReading::None;
    models::simplify::PaperMeasure measure = models::simplify::PaperMeasure::Plane;
    models::simplify::PaperResult result;
    models::measure::MeshDistance distance; ///< of the result to the original
    models::measure::MeshDefects defects;   ///< of the result
    double diagonal_m = 0.0;
    double time_ms = 0.0;
};

/// The three measures of the paper on one mesh; `progress` counts the results.
std::vector<PaperRun> paper_runs(
    const StudyMesh& mesh, std::size_t vertices, ColourReading colour, base::Progress& progress);

struct SimplificationStudyOptions : base::StudyOutput {
    std::optional<std::filesystem::path> bunny; ///< bun_zipper.ply; not shipped
    std::vector<std::filesystem::path> meshes;  ///< more meshes
    std::vector<std::size_t> faces;             ///< goals; empty = 15, 5 and 2.5 % of each mesh
    std::optional<std::filesystem::path> peers; ///< octant-peers; empty = the one beside us
    bool paper_only = false;                    ///< tables 1 and 2, nothing of other methods
};

/// Tables 1 and 2 of Y. Kim and B. U. Lee's "Error measure for vertex simplification" with ours beside, for the bunny
/// where it is given, the coloured globe, a torus, a finely cut F-15 and other meshes; then how far every way to
/// simplify, ours and other libraries', goes from the original and how long it takes. Prints the tables and writes them
/// to `out` as CSV and together as Markdown, with a figure as PNG. Throws Error.
void study_simplification(const SimplificationStudyOptions& options);

} // namespace octant::ui::studies::simplification
