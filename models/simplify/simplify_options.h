#pragma once

#include <cstddef>
#include <functional>
#include <optional>

namespace octant::models::simplify {

/// When to stop; the first that is met counts. All empty: as far as it goes.
struct Goal {
    std::optional<std::size_t> vertices;
    std::optional<std::size_t> faces;
    std::optional<double> error_m; ///< keep the two-sided distance to the original below this
};

/// Called now and then with the share that is done, 0..1.
using ShowProgress = std::function<void(double share)>;

enum class Quality {
    Surface, ///< distance to the triangles of the original surface, both ways
    Fast     ///< quadrics, and a short polish
};

struct SimplifyOptions {
    Quality quality = Quality::Surface;
    Goal goal;
    double colour_weight = 0.1; ///< of a colour difference of 1, in diagonals, against a distance
    /// Quality::Fast: so much of an edge's length counts as a distance too when the next collapse
    /// is chosen. Vertices of the result then stand for rounder parts of the original, which
    /// selective refinement can tell apart with fewer forced splits; about 0.03.
    double length_share = 0.0;
    int threads = 1;            ///< changes no result
    ShowProgress show_progress; ///< may be empty
};

} // namespace octant::models::simplify
