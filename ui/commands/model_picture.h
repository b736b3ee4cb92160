#pragma once

#include "models/triangle_mesh.h"
#include "ui/report/png_file.h"

namespace octant::ui::commands {

/// Three views of a mesh in body axes, side by side at one scale: from its left, from above (the
/// nose points left in both) and from ahead. Orthographic, in the colours of the mesh, lit from
/// the eye; what is seen from its back is half as bright. Same mesh, same bytes.
report::Picture three_views(const models::TriangleMesh& body, int pane_width_px, int height_px);

} // namespace octant::ui::commands
