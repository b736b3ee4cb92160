#pragma once

#include "models/measure/mesh_defects.h"
#include "models/measure/mesh_distance.h"
#include "models/simplify/paper_simplify.h"
#include "ui/studies/simplification/peer_program.h"
#include "ui/studies/simplification/simplification_meshes.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::studies::simplification {

/// Counted vertices that the paper stops at.
inline constexpr std::size_t paper_bunny_vertices = 2000;
inline constexpr std::size_t paper_globe_vertices = 5000;

/// w of the globe's distances in (position, w rgb), metres on a globe of 1 m radius: nearest to the
/// paper's table 2 within 0.01.
inline constexpr double globe_colour_weight_m = 0.12;

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

/// One result of any method, lengths as fractions of the original's diagonal.
struct QualityRun {
    std::string mesh;
    std::string method;
    std::size_t target_faces = 0;
    std::size_t faces = 0;
    double hausdorff = 0.0; ///< certified upper bound
    double rms = 0.0;
    std::optional<double> colour_rms;
    double time_ms = 0.0;
    bool peer = false;
    bool lindstrom_turk_name = false;
};

/// Called after each result.
using OnResult = std::function<void()>;

/// The three measures of the paper on one mesh.
std::vector<PaperRun>
paper_runs(const StudyMesh& mesh, std::size_t vertices, ColourReading colour, const OnResult& tick);

struct QualityOptions {
    std::filesystem::path program; ///< octant-peers
    std::vector<PeerMethod> peers; ///< that it has; empty = ours only
    std::filesystem::path folder;  ///< for files that go again
};

/// How many results quality_runs makes of a mesh for each number of faces.
int quality_methods(const QualityOptions& options);

/// Every method on one mesh, for each number of faces.
std::vector<QualityRun> quality_runs(
    const StudyMesh& mesh,
    const std::vector<std::size_t>& faces,
    const QualityOptions& options,
    const OnResult& tick);

} // namespace octant::ui::studies::simplification
