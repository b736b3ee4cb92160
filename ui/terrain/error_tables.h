#pragma once

#include "ui/report/html_text.h"
#include "ui/terrain/ground_view.h"
#include "ui/terrain/loaded_ground.h"
#include "visuals/scene/camera.h"

#include <optional>
#include <vector>

namespace octant::ui::terrain {

/// What `octant terrain error` measures.
struct ErrorRun {
    GroundViewOptions view;
    GroundMeshOptions mesh;
    std::vector<visuals::scene::Camera> cameras;
    std::optional<double> solve_px; ///< 99.9th percentile that meshes are sought for
    bool quiet = false;
};

/// A row a camera, and the mean where there are several: triangles and error. Throws Error as
/// mesh_as_asked.
report::HtmlTable error_table(const LoadedGround& ground, const ErrorRun& run);

/// Mean triangles at the same error: the run's mesh, Roettger's rule (mid-point roughness) with
/// full and with partial fans, its c the best for it of some. `run.solve_px` is there.
report::HtmlTable comparison_table(const LoadedGround& ground, const ErrorRun& run);

} // namespace octant::ui::terrain
