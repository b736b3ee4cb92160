#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>

namespace octant::models::simplify {

/// When to stop; whichever is reached first counts. All empty: as far as it goes.
struct Goal {
    std::optional<std::size_t> vertices;
    std::optional<std::size_t> faces;
    std::optional<double> error_m; ///< The two-sided distance to the original stays below this.
};

/// About how many triangles a goal without an error leaves.
inline std::size_t wanted_faces(const Goal& goal) {
    return goal.faces.value_or(2 * goal.vertices.value_or(0));
}

/// Called now and then with the share of the work that is done, 0 to 1.
using ShowProgress = std::function<void(double share)>;

/// What decides which edge collapses next.
enum class Quality {
    Surface, ///< The distance to the triangles of the original surface, both ways.
    Fast     ///< Quadrics, and only a short polish.
};

/// By what collapses were chosen.
enum class Chooser {
    Distances, ///< By distances to the original surface, both ways.
    Peaks,     ///< By the same, where a distance far above the usual one counts for all around it.
    Quadrics,  ///< By the sums of squared distances to the original planes, weighted by area.
    Planes,    ///< By the same, where each plane counts as much as any other.
    Volumes    ///< By the volumes that triangles sweep, without memory of the original.
};

/// Whether it measures distances to the original surface at each step.
constexpr bool measures_distances(Chooser chooser) {
    return chooser == Chooser::Distances || chooser == Chooser::Peaks;
}

/// Whether it takes what quadrics remember for the cost.
constexpr bool sums_planes(Chooser chooser) {
    return chooser == Chooser::Quadrics || chooser == Chooser::Planes;
}

/// How a mesh is simplified.
struct SimplifyOptions {
    Quality quality = Quality::Surface;
    Goal goal;
    /// What a colour difference of 1 counts as, against a distance, in diagonals of the bounding
    /// box.
    double colour_weight = 0.1;
    /// Quality::Fast: this share of an edge's length is added as a distance when the next collapse
    /// is chosen. Vertices of the result then stand for rounder regions of the original, which
    /// selective refinement can tell apart with fewer forced splits; about 0.03.
    double length_share = 0.0;
    /// No shell of a mesh may vanish, also where a goal cannot be reached then.
    bool keep_shells = false;
    /// Vertices of boundaries stay where they are, all of them.
    bool lock_border = false;
    /// Triangles that are no higher than the error so far may turn over (collapse_guard.h).
    /// fast_sequence lets none: selective refinement shows every state between.
    bool low_may_turn = true;
    /// Choosers that measure distances, and the polish, keep distances to the original below this
    /// where they can; best_of_passes tries it out (passes.h).
    double avoided_m = std::numeric_limits<double>::infinity();
    /// Chooser::Distances may make slivers of uncoloured triangles, as the plain choosers may.
    bool slivers_too = false;
    /// The polish may make slivers of uncoloured triangles; best_of_passes tries it out.
    bool fits_slivers = false;
    /// Quality::Fast: the polish lowers the largest distance, too; best_of_passes tries it out.
    bool lowers_peaks = false;
    int threads = 1;            ///< The number of threads; it does not change the result.
    ShowProgress show_progress; ///< May be empty.
};

} // namespace octant::models::simplify
