#pragma once

#include "visuals/raster/projection.h"
#include "visuals/raster/triangle.h"

#include <array>
#include <cstdint>

namespace octant::visuals::raster {

/// Levels a pixel above which a triangle counts as a sliver, whose colours beyond its edges mean nothing.
constexpr double sliver_per_px = 64.0;

constexpr double any_per_px = 16000.0; ///< no triangle counts as a sliver

/// Three corners from top to bottom.
struct TopDownVertices {
    const ScreenVertex& top;
    const ScreenVertex& middle;
    const ScreenVertex& bottom;
    /// Twice the area, 1/256 pixel squared; not 0. Its sign says on which side the middle lies.
    std::int64_t doubled_area;
};

/// Fills in the edges of a triangle, and its inverse depth if it has detail texture. Its box is known.
void set_edges(const TopDownVertices& vertices, Triangle& triangle);

/// Fills in these and the four values at the corners as planes of levels. Where a level would change by more than
/// `max_per_px` it is the corners' mean.
void set_edges_and_gradients(const TopDownVertices& vertices, double max_per_px, Triangle& triangle);

/// The levels of a triangle that has one colour everywhere.
ColourGradients constant_gradients(const std::array<float, 3>& rgb);

} // namespace octant::visuals::raster
