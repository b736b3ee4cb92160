#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace octant::visuals::terrain {

/// How much the number of triangles changes from frame to frame in a run N_0, N_1, ..., where dn_k
/// = N_k - N_{k-1} for k >= 1.
struct ChangeStatistics {
    double mean = 0.0; ///< The mean of |dn|.
    int largest = 0;   ///< The largest |dn|.
    /// Flicker, in triangles a frame: the sum of min(|dn_k|, |dn_{k-1}|) over all k at which dn_k and dn_{k-1} have
    /// opposite signs, divided by the number of frames. A change that is taken back in the next frame counts with the
    /// amount taken back; steady growth counts nothing.
    double flicker_triangles = 0.0;
};

/// The figures of the changes dn_k with k >= `first`, where first >= 1. All are zero when there are no such changes.
ChangeStatistics change_statistics(std::span<const int> triangles, std::size_t first);

/// The number of frames before the frame from which on dn = 0 until the end; nothing when those are fewer than
/// `stable_frames` frames.
std::optional<int> frames_until_constant(std::span<const int> triangles, std::size_t stable_frames);

/// The number of frames before the first one from which on `stable_frames` frames in a row miss `target` by at most
/// `share` of it; nothing when there is none.
std::optional<int> frames_until_within(std::span<const int> triangles, int target, double share, int stable_frames);

} // namespace octant::visuals::terrain
