#pragma once

#include "ui/studies/refinement/refinement_tables.h"

#include <filesystem>
#include <string>

namespace octant::ui::studies::refinement {

/// The paper's figure of what refinement means: a model, its base mesh, the parts of the model that
/// the base mesh's vertices stand for, and the base mesh with one part (a cow's chest: front, low)
/// refined all the way. Writes four PNG to `folder`, returns the Markdown that shows them. `y_up`:
/// else z is. The model is seen from its right, its front is at +x. Throws Error.
std::string write_refinement_pictures(
    const RefinedModel& model, bool y_up, const std::filesystem::path& folder);

} // namespace octant::ui::studies::refinement
