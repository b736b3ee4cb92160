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
    std::optional<double> target_error_px; ///< find the coarsest mesh whose 99.9th error percentile is at most this
    bool quiet = false;
};

/// Triangles and errors, a row for each camera and one for the mean of several. Throws Error as mesh_from_options.
report::ResultTable error_table(const LoadedGround& ground, const ErrorMeasurement& run);

/// Mean numbers of triangles at the same error, run.target_error_px, which must be set: the run's mesh, and Roettger's
/// rule (mid-point roughness) with full and with partial fans, each with the best of several values of c.
report::ResultTable comparison_table(const LoadedGround& ground, const ErrorMeasurement& run);

} // namespace octant::ui::terrain
