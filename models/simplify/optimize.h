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
    /// Called repeatedly; true ends the optimization. May be empty.
    std::function<bool()> has_timed_out;
    std::function<void(double share)> show_progress; ///< May be empty.
};

/// Lowers the two-sided error between a surface and samples of its original at a constant number of triangles:
/// repeatedly applies the step with the best expected reduction per unit of work. Returns the number of steps; very
/// large steps count several times.
std::size_t optimize(
    WorkingSurface& surface, SurfaceSamples& samples, const OriginalSurface& original, const OptimizeOptions& options);

} // namespace octant::models::simplify
