#pragma once

#include "ui/report/html_text.h"
#include "visuals/refine/progressive_mesh.h"

#include <memory>
#include <span>

namespace octant::ui::studies::refinement {

using RefinedModel = std::shared_ptr<const visuals::refine::ProgressiveMesh>;

/// Splits that each rule forces, percent of those requested; faces turned over without repair and what repair costs.
/// One base vertex after another, and spheres of shares of the diagonal.
report::HtmlTable forced_splits_table(std::span<const RefinedModel> models);

/// Operations a second on one core and memory.
report::HtmlTable refinement_speed_table(std::span<const RefinedModel> models);

/// A view that goes around each model and nearer and back: operations a frame, steps of vertices.
report::HtmlTable refinement_path_table(std::span<const RefinedModel> models, int frames);

} // namespace octant::ui::studies::refinement
