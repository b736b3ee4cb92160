#include "ui/studies/simplification/simplification_runs.h"

#include "models/simplify/simplify.h"
#include "sim/base/parallel_for.h"
#include "ui/base/stopwatch.h"

#include <string>

namespace octant::ui::studies::simplification {

namespace {

namespace measure = models::measure;
namespace simplify = models::simplify;
using models::TriangleMesh;
using simplify::PaperMeasure;

constexpr std::size_t own_methods = 3;

measure::MeshDistance distance_to(const TriangleMesh& original, const TriangleMesh& result) {
    measure::DistanceOptions options;
    options.tightness = 1.02;
    options.samples = 100'000;
    options.threads = core_count();
    return measure::distance(original, result, options);
}

/// The methods on one mesh and one number of faces.
class QualityRow {
public:
    QualityRow(const StudyMesh& mesh, std::size_t faces, const OnResult& tick)
        : mesh_(mesh)
        , faces_(faces)
        , tick_(tick) {}

    void add(const char* method, const TriangleMesh& result, double time_ms) {
        QualityRun& run = runs.emplace_back();
        run.mesh = mesh_.name;
        run.method = method;
        run.target_faces = faces_;
        run.faces = result.triangles.size();
        run.time_ms = time_ms;
        if (result.triangles.empty()) {
            run.hausdorff = run.rms = 1.0;
        } else {
            const measure::MeshDistance found = distance_to(mesh_.clean, result);
            run.hausdorff = found.max_hausdorff_m() / mesh_.diagonal_m;
            run.rms = found.rms_m() / mesh_.diagonal_m;
            if (!mesh_.clean.colours.empty() && !result.colours.empty()) {
                run.colour_rms = found.colour_rms();
            }
        }
        tick_();
    }

    void add_ours(const char* method, int effort) {
        simplify::SimplifyOptions options;
        options.effort = effort;
        options.goal.faces = faces_;
        const base::Stopwatch watch;
        const simplify::Simplified result = simplify::simplified(mesh_.clean, options);
        add(method, result.mesh, watch.ms());
    }

    void add_paper(const char* method) {
        simplify::PaperOptions options;
        options.goal.faces = faces_;
        const base::Stopwatch watch;
        const simplify::PaperResult result = simplify::paper_simplified(mesh_.clean, options);
        add(method, result.mesh, watch.ms());
    }

    void add_peers(const QualityOptions& options) {
        for (const PeerMethod& peer : options.peers) {
            const auto result =
                simplified_by_peer(options.program, peer.name, mesh_.clean, faces_, options.folder);
            if (!result) {
                continue;
            }
            add(peer.shown, result->mesh, result->time_ms);
            runs.back().peer = true;
            runs.back().lindstrom_turk_name = std::string(peer.name) == lindstrom_turk_name;
        }
    }

    std::vector<QualityRun> runs;

private:
    const StudyMesh& mesh_;
    std::size_t faces_;
    const OnResult& tick_;
};

} // namespace

std::vector<PaperRun>
paper_runs(const StudyMesh& mesh, std::size_t vertices, ColourReading colour, const OnResult& tick) {
    std::vector<PaperRun> runs;
    for (const PaperMeasure by :
         {PaperMeasure::Plane, PaperMeasure::Triangle, PaperMeasure::Bidirectional}) {
        simplify::PaperOptions options;
        options.measure = by;
        options.goal.vertices = vertices;
        options.colour_weight = colour == ColourReading::None ? 0.0 : globe_colour_weight_m;
        options.colour_in_edge_length = colour == ColourReading::DistanceAndLength;
        PaperRun& run = runs.emplace_back();
        run.mesh = mesh.name;
        run.colour = colour;
        run.measure = by;
        run.diagonal_m = mesh.diagonal_m;
        const base::Stopwatch watch;
        run.result = simplify::paper_simplified(mesh.original, options);
        run.time_ms = watch.ms();
        run.distance = distance_to(mesh.original, run.result.mesh);
        run.defects = measure::defects(run.result.mesh);
        tick();
    }
    return runs;
}

int quality_methods(const QualityOptions& options) {
    return static_cast<int>(own_methods + options.peers.size());
}

std::vector<QualityRun> quality_runs(
    const StudyMesh& mesh,
    const std::vector<std::size_t>& faces,
    const QualityOptions& options,
    const OnResult& tick) {
    std::vector<QualityRun> runs;
    for (const std::size_t wanted : faces) {
        QualityRow row(mesh, wanted, tick);
        row.add_ours("Octant, surface", simplify::surface_effort);
        row.add_ours("Octant, fast", simplify::fast_effort);
        row.add_paper("2005, both directions");
        row.add_peers(options);
        runs.insert(runs.end(), row.runs.begin(), row.runs.end());
    }
    return runs;
}

} // namespace octant::ui::studies::simplification
