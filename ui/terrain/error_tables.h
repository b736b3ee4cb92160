#pragma once

#include "ui/report/table.h"
#include "ui/terrain/ground_view.h"
#include "visuals/scene/camera.h"

#include <optional>
#include <vector>

namespace octant::ui::terrain {

/// What `octant terrain error` measures.
struct ErrorMeasurement {
    GroundViewOptions view;
    GroundMeshOptions mesh;
    std::vector<visuals::scene::Camera> cameras;
    std::optional<double> target_error_px; ///< 99.9th percentile that meshes are sought for
    bool quiet = false;
};

/// A row a camera, and the mean where there are several: triangles and error. Throws Error as mesh_from_options.
report::ResultTable error_table(const LoadedGround& ground, const ErrorMeasurement& run);

/// Mean triangles at the same error: the run's mesh, Roettger's rule (mid-point roughness) with full and with partial
/// fans, with the best of several values of c. `run.target_error_px` is there.
report::ResultTable comparison_table(const LoadedGround& ground, const ErrorMeasurement& run);

} // namespace octant::ui::terrain
