#pragma once

#include "models/simplify/paper_simplify.h"
#include "models/triangle_mesh.h"
#include "ui/base/json_value.h"

namespace octant::ui::commands {

/// Adds what the 2005 paper states about its runs to the figures of `octant simplify`: how the paper was read,
/// contractions, feet of perpendiculars, sums of the errors, and what is no manifold any more because the paper has no
/// test that keeps it.
void add_paper_results(base::JsonValue& results, const models::simplify::PaperOptions& options,
    const models::simplify::PaperResult& result);

} // namespace octant::ui::commands
