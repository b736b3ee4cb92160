#pragma once

#include "models/measure/mesh_defects.h"
#include "models/measure/mesh_distance.h"
#include "models/simplify/paper_simplify.h"
#include "models/triangle_mesh.h"
#include "ui/base/study_output.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::studies::simplification {

/// A way to simplify of another library.
struct PeerMethod {
    const char* name;  ///< as the program octant-peers knows it
    const char* shown; ///< in tables
};

inline constexpr const char* lindstrom_turk_name = "cgal-lindstrom-turk";

/// What the program was built with, tried on a small mesh. Throws Error as simplified_by_peer.
std::vector<PeerMethod> methods_of_peer(const std::filesystem::path& program, const std::filesystem::path& folder);

/// The program octant-peers beside ours; nothing when it is not there.
std::optional<std::filesystem::path> find_peer_program();

struct PeerResult {
    models::TriangleMesh mesh;
    double time_ms = 0.0; ///< median, without reading and writing
};

/// Simplifies by another library: a program is run in `folder`, which must be there, on files that are removed again.
/// Nothing when the program was built without that library. Throws Error when it cannot be run or fails.
std::optional<PeerResult> simplified_by_peer(const std::filesystem::path& program, const std::string& method,
    const models::TriangleMesh& mesh, std::size_t faces, const std::filesystem::path& folder);

/// A mesh of the simplification study.
struct StudyMesh {
    std::string name;
    models::TriangleMesh original; ///< as read or made
    models::TriangleMesh clean;    ///< repaired, without materials and normals
    double diagonal_m = 0.0;
};

/// The Stanford bunny as the paper used it. Throws Error for a file with other numbers of vertices and faces.
StudyMesh bunny_from(const std::filesystem::path& file);

/// A mesh from a file. Throws Error.
StudyMesh study_mesh_from(const std::filesystem::path& file);

/// The coloured globe, a torus of 32,768 triangles, and what has sharp edges: a machined part, and the F-15 with every
/// triangle cut in four until there are 40,000.
std::vector<StudyMesh> built_in_mesh_names();

/// The same mesh without the colours of its vertices.
StudyMesh uncoloured(StudyMesh mesh);

/// Counted vertices that the paper stops at.
inline constexpr std::size_t paper_bunny_vertices = 2000;
inline constexpr std::size_t paper_globe_vertices = 5000;

/// w of the globe's distances in (position, w rgb), metres on a globe of 1 m radius: nearest to the paper's table 2
/// within 0.01.
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
std::vector<PaperRun> paper_runs(
    const StudyMesh& mesh, std::size_t vertices, ColourReading colour, const OnResult& tick);

struct QualityOptions {
    std::filesystem::path program; ///< octant-peers
    std::vector<PeerMethod> peers; ///< that it has; empty = ours only
    std::filesystem::path folder;  ///< for files that go again
};

/// How many results quality_runs makes of a mesh for each number of faces.
int quality_methods(const QualityOptions& options);

/// Every method on one mesh, for each number of faces.
std::vector<QualityRun> quality_runs(
    const StudyMesh& mesh, const std::vector<std::size_t>& faces, const QualityOptions& options, const OnResult& tick);

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
