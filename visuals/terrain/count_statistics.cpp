// Figures for how quietly the number of triangles is held: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that
// Minimize Flickering Effect", section 4, which plots dn for each frame.
//
// Deviations: the paper gives plots and no figures. Sign changes of dn alone mean nothing, because even the quietest
// run alternates by a few triangles; they are weighted by the amount that is taken back.
#include "visuals/terrain/count_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace octant::visuals::terrain {

ChangeStatistics change_statistics(std::span<const int> triangles, std::size_t first) {
    ChangeStatistics figures;
    if (first < 1 || first >= triangles.size()) { return figures; }
    const auto change = [&](std::size_t k) { return triangles[k] - triangles[k - 1]; };
    const auto frames = static_cast<double>(triangles.size() - first);
    for (std::size_t k = first; k < triangles.size(); ++k) {
        const int size = std::abs(change(k));
        figures.mean += size / frames;
        figures.largest = std::max(figures.largest, size);
        if (k > first && (change(k) > 0) != (change(k - 1) > 0)) {
            figures.flicker_triangles += std::min(size, std::abs(change(k - 1))) / frames;
        }
    }
    return figures;
}

std::optional<int> frames_until_constant(std::span<const int> triangles, std::size_t stable_frames) {
    std::size_t first = triangles.size();
    while (first > 0 && triangles[first - 1] == triangles.back()) { --first; }
    return triangles.size() - first < stable_frames ? std::nullopt : std::optional(static_cast<int>(first));
}

std::optional<int> frames_until_within(std::span<const int> triangles, int target, double share, int stable_frames) {
    int near = 0;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        near = std::abs(triangles[k] - target) <= share * target ? near + 1 : 0;
        if (near == stable_frames) { return static_cast<int>(k) + 1 - stable_frames; }
    }
    return std::nullopt;
}

} // namespace octant::visuals::terrain
