#pragma once

#include "visuals/separation/linear_program.h"

#include <optional>
#include <vector>

namespace octant::visuals::separation {

/// The variables of an optimum to nearly all of their digits; nothing where none is found.
std::optional<std::vector<double>> refined_optimum(const LinearProgram& program);

} // namespace octant::visuals::separation
