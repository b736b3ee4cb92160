#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace octant::visuals::terrain {

// Figures of a run's triangles per frame N_0, N_1, ...; dn_k = N_k - N_{k-1} for k >= 1.

struct ChangeFigures {
    double mean = 0.0; ///< of |dn|
    int largest = 0;   ///< of |dn|
    /// Flicker: sum of min(|dn_k|, |dn_{k-1}|) over all k where dn_k and dn_{k-1} have opposite
    /// signs, divided by the number of frames. A change that is taken back in the next frame counts
    /// with what is taken back; growing or shrinking steadily counts nothing. Triangles a frame.
    double alternation = 0.0;
};

/// Of the changes dn_k with k >= `first`, first >= 1. All zero where there are none.
ChangeFigures change_figures(std::span<const int> triangles, std::size_t first);

/// Frames before the one from which on dn = 0 up to the end; nothing where those are fewer than
/// `standing` frames.
std::optional<int> frames_until_still(std::span<const int> triangles, std::size_t standing);

/// Frames before the first from which on `standing` frames in a row miss `target` by at most
/// `share` of it; nothing where there are none.
std::optional<int>
frames_until_near(std::span<const int> triangles, int target, double share, int standing);

} // namespace octant::visuals::terrain
