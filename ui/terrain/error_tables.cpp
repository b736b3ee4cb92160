#include "ui/terrain/error_tables.h"

#include "ui/base/progress.h"
#include "ui/settings/settings_text.h"
#include "ui/terrain/mesh_maker.h"
#include "visuals/terrain/mesh_measurement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <functional>
#include <span>
#include <string>

namespace octant::ui::terrain {

namespace {

/// A mesh and how far it misses the ground.
struct MeasuredMesh {
    int triangles = 0;
    int triangles_in_view = 0; ///< not wholly outside the frustum
    double coarseness = 0.0;   ///< as MeshMaker::mesh takes it
    visuals::terrain::ProjectedError error;
};

namespace terrain = visuals::terrain;

/// The coarsest mesh found by bisection whose 99.9th percentile of the error is at most `target_px`; the finest there
/// is where none is.
MeasuredMesh coarsest_mesh_within(MeshMaker& maker, terrain::ProjectedErrorMeter& meter, const terrain::MeshView& view,
    const terrain::PerspectiveView& picture, double target_px) {
    const auto measured = [&](double coarseness) {
        const terrain::GroundMesh mesh = maker.mesh(view, coarseness);
        MeasuredMesh found;
        found.coarseness = coarseness;
        found.error = meter.measure(mesh, picture, view.earth_radius_m);
        found.triangles = mesh.counters.triangles;
        found.triangles_in_view = found.error.triangles_in_view;
        return found;
    };
    const MeshMaker::Range range = maker.range();
    double fine = std::log(range.finest);
    double coarse = std::log(range.coarsest);
    MeasuredMesh best = measured(range.coarsest);
    if (best.error.p999_px <= target_px) { return best; }
    best.coarseness = 0.0;
    constexpr double close_enough = 0.002; // of the error, and of the coarseness
    while (coarse - fine > close_enough) {
        const double middle = 0.5 * (fine + coarse);
        const MeasuredMesh tried = measured(std::exp(middle));
        if (tried.error.p999_px > target_px) {
            coarse = middle;
            continue;
        }
        fine = middle;
        best = tried;
        if (tried.error.p999_px >= (1.0 - close_enough) * target_px) { break; }
    }
    return best.coarseness > 0.0 ? best : measured(range.finest);
}

} // namespace

namespace scene = visuals::scene;

namespace {

/// Meshes of all cameras, by one maker.
std::vector<MeasuredMesh> measured_meshes(
    const LoadedGround& ground, const ErrorMeasurement& run, const std::string& what) {
    const auto maker = make_mesh_maker(ground, run.mesh);
    terrain::ProjectedErrorMeter meter(maker->ground());
    base::Progress progress(what, static_cast<int>(run.cameras.size()), run.quiet, "views");
    std::vector<MeasuredMesh> found;
    for (const scene::Camera& camera : run.cameras) {
        const terrain::MeshView view = mesh_view(camera, run.view);
        const terrain::PerspectiveView picture = picture_view(camera, run.view.size_px);
        if (run.target_error_px) {
            found.push_back(coarsest_mesh_within(*maker, meter, view, picture, *run.target_error_px));
        } else {
            const terrain::GroundMesh mesh = mesh_from_options(*maker, view, run.mesh);
            MeasuredMesh one;
            one.triangles = mesh.counters.triangles;
            one.coarseness = mesh.error_px > 0.0 ? mesh.error_px : 1.0 / mesh.resolution;
            one.error = meter.measure(mesh, picture, view.earth_radius_m);
            one.triangles_in_view = one.error.triangles_in_view;
            found.push_back(one);
        }
        progress.show(static_cast<int>(found.size()));
    }
    return found;
}

double mean_triangles_in_view(const std::vector<MeasuredMesh>& meshes) {
    double sum = 0.0;
    for (const MeasuredMesh& mesh : meshes) { sum += mesh.triangles_in_view; }
    return sum / static_cast<double>(meshes.size());
}

/// A row of a table of errors: means over the meshes.
std::vector<report::Cell> row_of(const std::string& name, std::span<const MeasuredMesh> meshes, bool by_error) {
    const auto mean = [&](const auto& value_of) {
        double sum = 0.0;
        for (const MeasuredMesh& mesh : meshes) {
            sum += static_cast<double>(std::invoke(value_of, mesh)) / static_cast<double>(meshes.size());
        }
        return sum;
    };
    const auto mean_error = [&](double terrain::ProjectedError::*part) {
        return mean([&](const MeasuredMesh& mesh) { return mesh.error.*part; });
    };
    const double coarseness =
        mean([&](const MeasuredMesh& mesh) { return by_error ? mesh.coarseness : 1.0 / mesh.coarseness; });
    return {{"view", name}, {"triangles", "{:.0f}", mean(&MeasuredMesh::triangles)},
        {"in view", "{:.0f}", mean(&MeasuredMesh::triangles_in_view)},
        {by_error ? "error px" : "C", "{:.4g}", coarseness},
        {"maximum px", "{:.4g}", mean_error(&terrain::ProjectedError::maximum_px)},
        {"99.9 % px", "{:.4g}", mean_error(&terrain::ProjectedError::p999_px)},
        {"99 % px", "{:.4g}", mean_error(&terrain::ProjectedError::p99_px)},
        {"rms px", "{:.4g}", mean_error(&terrain::ProjectedError::rms_px)},
        {"mean px", "{:.4g}", mean_error(&terrain::ProjectedError::mean_px)},
        {"samples", "{:.0f}", mean([](const MeasuredMesh& mesh) { return mesh.error.samples; })},
        {"uncovered", "{:.0f}", mean([](const MeasuredMesh& mesh) { return mesh.error.uncovered; })}};
}

/// Roettger's rule: the c with which it needs the fewest triangles.
struct BestRoughness {
    double roughness_c = 0.0;
    double triangles = 0.0;
};

BestRoughness best_of_roettger(const LoadedGround& ground, const ErrorMeasurement& run, terrain::FanKind fans) {
    constexpr std::array<double, 5> weights = {10.0, 20.0, 40.0, 80.0, 160.0};
    BestRoughness best;
    for (const double weight : weights) {
        ErrorMeasurement other = run;
        other.mesh = {};
        other.mesh.lod.metric = terrain::GroundMetric::Midpoint;
        other.mesh.lod.fans = fans;
        other.mesh.lod.roughness_c = weight;
        const double triangles = mean_triangles_in_view(
            measured_meshes(ground, other, fmt::format("{} fans, c = {}", settings::text_of(fans), weight)));
        if (best.triangles == 0.0 || triangles < best.triangles) { best = {weight, triangles}; }
    }
    return best;
}

} // namespace

report::ResultTable error_table(const LoadedGround& ground, const ErrorMeasurement& run) {
    const bool by_error = terrain::ground_metric(run.mesh.lod) == terrain::GroundMetric::ScreenError;
    const std::vector<MeasuredMesh> meshes =
        measured_meshes(ground, run, settings::text_of(terrain::ground_metric(run.mesh.lod)));
    report::ResultTable table{
        fmt::format("Projected error of {} meshes", settings::text_of(terrain::ground_metric(run.mesh.lod)))};
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        table.add(row_of(fmt::format("{}", k + 1), std::span(meshes).subspan(k, 1), by_error));
    }
    if (meshes.size() > 1) { table.add(row_of("mean", meshes, by_error)); }
    table.note = "Every sample of the field inside the frustum (near 10 m) counts once: distance "
                 "on the screen to the mesh's surface at the same place. In view: triangles not "
                 "wholly outside the frustum, back faces included.";
    return table;
}

report::ResultTable comparison_table(const LoadedGround& ground, const ErrorMeasurement& run) {
    const double own =
        mean_triangles_in_view(measured_meshes(ground, run, settings::text_of(terrain::ground_metric(run.mesh.lod))));
    const BestRoughness full = best_of_roettger(ground, run, terrain::FanKind::Full);
    const BestRoughness partial = best_of_roettger(ground, run, terrain::FanKind::Partial);
    report::ResultTable table{fmt::format("Triangles in view at {:.4g} px", *run.target_error_px)};
    const auto row = [&](const std::string& name, double triangles, const std::string& c) {
        table.add({{"mesh", name}, {"triangles", "{:.0f}", triangles}, {"c", c}, {"ratio", "{:.3f}", own / triangles}});
    };
    row(settings::text_of(terrain::ground_metric(run.mesh.lod)), own, "");
    row("Roettger, full fans", full.triangles, fmt::format("{}", full.roughness_c));
    row("Roettger, partial fans", partial.triangles, fmt::format("{}", partial.roughness_c));
    table.note = "Mean over the views at equal 99.9th percentile of the error. Ratio: the first "
                 "mesh's triangles over this one's.";
    return table;
}

} // namespace octant::ui::terrain
