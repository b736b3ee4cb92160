#pragma once

#include "visuals/scene/paint_step.h"

#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::raster {

/// The depth group of each step, from 1; 0 = drawn without depth. A group begins where depth is
/// cleared, or where it is first used, and ends with the last step that uses it before it is
/// cleared again; what is drawn without depth in between belongs to it, since its samples may be
/// drawn over.
std::vector<std::uint16_t> depth_groups(std::span<const scene::PaintStep> steps);

} // namespace octant::visuals::raster
