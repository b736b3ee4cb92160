#pragma once

#include "models/simplify/local_error.h"
#include "models/simplify/surface_samples.h"
#include "models/simplify/working_surface.h"

#include <chrono>
#include <cstddef>
#include <optional>

namespace octant::models::simplify {

/// How much work an optimization may do.
struct OptimizeOptions {
    std::size_t max_steps = 0;
    /// The optimization ends at this time.
    std::optional<std::chrono::steady_clock::time_point> deadline;
};

/// Lowers the two-sided error between a surface and samples of its original at a constant number of triangles:
/// repeatedly applies the step with the best expected reduction per unit of work. Returns the number of steps; very
/// large steps count several times.
std::size_t optimize(
    WorkingSurface& surface, SurfaceSamples& samples, const OriginalSurface& original, const OptimizeOptions& options);

} // namespace octant::models::simplify
