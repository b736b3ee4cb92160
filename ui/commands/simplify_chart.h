#pragma once

#include "models/meshfile/level_chain.h"

#include <string>

namespace octant::ui::commands {

/// A page with a plot and a table of the errors of a mesh's levels of detail by their faces: one
/// HTML text without scripts or outside references. `mesh` is the name of its file. Throws Error
/// where gnuplot is missing or there is one level only.
std::string chart_page(const std::string& mesh, const models::meshfile::LevelChain& chain);

} // namespace octant::ui::commands
