#include "ui/terrain/mesh_search.h"

#include <algorithm>
#include <cmath>

namespace octant::ui::terrain {

namespace terrain = visuals::terrain;

MeasuredMesh coarsest_mesh_within(
    MeshMaker& maker,
    terrain::ProjectedErrorMeter& meter,
    const terrain::MeshView& view,
    const terrain::PerspectiveView& picture,
    double target_px) {
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
    if (best.error.p999_px <= target_px) {
        return best;
    }
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
        if (tried.error.p999_px >= (1.0 - close_enough) * target_px) {
            break;
        }
    }
    return best.coarseness > 0.0 ? best : measured(range.finest);
}

} // namespace octant::ui::terrain
