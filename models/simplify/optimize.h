#pragma once

#include "models/simplify/local_error.h"
#include "models/simplify/surface_samples.h"
#include "models/simplify/working_surface.h"

#include <cstddef>
#include <functional>

namespace octant::models::simplify {

/// How much work an optimization may do.
struct OptimizeOptions {
    std::size_t max_steps = 0;
    /// Asked now and then; true ends the optimization. May be empty.
    std::function<bool()> has_timed_out;
    std::function<void(double share)> show_progress; ///< May be empty.
};

/// Lowers the error of a surface against samples of its original, both ways, without changing its number of triangles:
/// applies the step with the best reduction per unit of work. Returns how many steps were tried, where very large ones
/// count several times.
std::size_t optimize(
    WorkingSurface& surface, SurfaceSamples& samples, const OriginalSurface& original, const OptimizeOptions& options);

} // namespace octant::models::simplify
