#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>

namespace octant::models::simplify {

/// When to stop; whichever is reached first counts. All empty: as far as it goes.
struct Goal {
    std::optional<std::size_t> vertices;
    std::optional<std::size_t> faces;
    std::optional<double> error_m; ///< The two-sided distance to the original stays below this.
};

/// About how many triangles a goal without an error leaves.
inline std::size_t target_faces(const Goal& goal) { return goal.faces.value_or(2 * goal.vertices.value_or(0)); }

/// Called now and then with the share of the work that is done, 0 to 1.
using ShowProgress = std::function<void(double share)>;

/// The efforts of --method fast and surface.
inline constexpr int fast_effort = 1;
inline constexpr int surface_effort = 4;

/// How a mesh is simplified.
struct SimplifyOptions {
    Goal goal;
    /// 0 to 9; 0 = collapses alone. Each one more doubles the steps, as long as some help.
    int effort = surface_effort;
    /// The steps of all optimizations together, instead of those that follow from the effort.
    std::optional<std::size_t> steps;
    /// Optimizations end at this time. The result then depends on the machine; Simplified::steps repeats it.
    std::optional<std::chrono::steady_clock::time_point> deadline;
    /// With steps or a deadline: each optimization of several makes no more steps than those of the effort, so that
    /// some are left for the next one. Always so for a wanted error.
    bool effort_limits_each = false;
    /// What a colour difference of 1 counts as, against a distance, in diagonals of the bounding box.
    double colour_weight = 0.1;
    /// fast_sequence: this share of an edge's length is added as a distance when the next collapse is chosen. Vertices
    /// of the result then stand for rounder regions of the original, which selective refinement can tell apart with
    /// fewer forced splits; about 0.03.
    double length_share = 0.0;
    /// No shell of a mesh may vanish, also where a goal cannot be reached then.
    bool keep_shells = false;
    /// No hole is closed and no handle cut either.
    bool keep_topology = false;
    /// For a wanted error, shells are dropped that are nearer to others than this share of it.
    double shell_error_share = 0.8;
    /// Vertices of boundaries stay where they are, all of them.
    bool lock_border = false;
    int threads = 1;            ///< The number of threads; it does not change the result.
    ShowProgress show_progress; ///< May be empty.
};

} // namespace octant::models::simplify
