#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace octant::ui::commands {

/// One row and point of a chart.
struct ChartLevel {
    std::size_t faces = 0;
    double error_m = 0.0; ///< the largest distance to the mesh, certified
    std::string made_by;  ///< the command that makes it, or what it is
};

/// A page with a plot and a table of the errors of a mesh's levels of detail by their faces: one HTML text without
/// scripts or outside references, without the plot where all levels are exact. `mesh` is the name of its file, `levels`
/// begin with the mesh itself. Throws Error where gnuplot is missing.
std::string chart_page(const std::string& mesh, const std::vector<ChartLevel>& levels, double diagonal_m);

} // namespace octant::ui::commands
