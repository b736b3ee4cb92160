#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>

namespace octant::models::simplify {

/// When to stop: at the first limit that is reached. All empty: when no edge can collapse.
struct Goal {
    std::optional<std::size_t> vertices = {};
    std::optional<std::size_t> faces = {};
    std::optional<double> error_m = {}; ///< Upper limit of the two-sided distance to the original.
};

/// The approximate number of triangles after a goal without an error limit.
inline std::size_t target_faces(const Goal& goal) { return goal.faces.value_or(2 * goal.vertices.value_or(0)); }

/// Called repeatedly with the completed share of the work, 0 to 1.
using ShowProgress = std::function<void(double share)>;

/// The efforts of --method fast and surface.
inline constexpr int fast_effort = 1;
inline constexpr int surface_effort = 4;

/// How a mesh is simplified.
struct SimplifyOptions {
    Goal goal;
    /// 0 to 9; 0 = collapses only. Each increment doubles the steps, as long as steps help.
    int effort = surface_effort;
    /// The total number of steps of all optimizations; replaces the number that `effort` implies.
    std::optional<std::size_t> steps;
    /// Optimizations end at this time. The result then depends on the machine; `steps` = Simplified::steps reproduces
    /// it.
    std::optional<std::chrono::steady_clock::time_point> deadline;
    /// With `steps` or `deadline`: limits each of several optimizations to the steps of the effort, which leaves steps
    /// for the next one. Always on for an error limit.
    bool effort_limits_each = false;
    /// The distance that a colour difference of 1 is equivalent to, in diagonals of the bounding box.
    double colour_weight = 0.1;
    /// fast_sequence: this share of an edge's length is added to the distance that orders collapses. It makes the
    /// regions that a vertex represents rounder, which saves forced splits in selective refinement; about 0.03.
    double length_share = 0.0;
    /// No shell of a mesh may vanish, even if the goal cannot be reached then.
    bool keep_shells = false;
    /// In addition no hole is closed and no handle is cut.
    bool keep_topology = false;
    /// With an error limit, shells that are closer to other shells than this share of it are dropped.
    double shell_error_share = 0.8;
    /// All boundary vertices stay at their positions.
    bool lock_border = false;
    int threads = 1;            ///< The number of threads; it does not change the result.
    ShowProgress show_progress; ///< May be empty.
};

} // namespace octant::models::simplify
