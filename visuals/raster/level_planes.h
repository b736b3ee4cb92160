#pragma once

#include "visuals/raster/screen_vertex.h"
#include "visuals/raster/triangle.h"

#include <array>
#include <cstddef>

namespace octant::visuals::raster {

/// Levels a pixel above which a triangle counts as a sliver, whose colours beyond its edges mean
/// nothing.
constexpr double sliver_per_px = 64.0;

/// The first `count` values at three corners of a doubled area in 1/256 pixel squared as planes.
/// Where a level would change by more than `most_per_px` it is the corners' mean.
Levels levels_between(
    const std::array<const ScreenVertex*, 3>& corners,
    double doubled_area,
    std::size_t count = 3,
    double most_per_px = sliver_per_px);

/// One colour everywhere.
Levels even_levels(const std::array<float, 3>& rgb);

} // namespace octant::visuals::raster
