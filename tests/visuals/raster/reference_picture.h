#pragma once

#include "tests/visuals/raster/flat_plan.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::raster {

/// For each sample of each pixel, row after row, the last triangle that covers it, from 1, or 0: by whole-number side
/// tests in 1/8192 pixel of corners rounded to 1/256 pixel. A sample on an edge belongs to the triangle on its right,
/// or below where the edge is level. Shares no code with the renderer.
std::vector<std::uint32_t> covered_by(
    const std::vector<FlatTriangle>& triangles, const glm::ivec2& size_px, int samples);

} // namespace octant::visuals::raster
