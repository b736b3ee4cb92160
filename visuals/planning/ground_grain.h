#pragma once

#include "visuals/landscape/ground.h"
#include "visuals/planning/frame_view.h"
#include "visuals/scene/frame_plan.h"

#include <optional>

namespace octant::visuals::planning {

/// Where the fine pattern lies on the ground of a frame, and how far it reaches: farther than its
/// coarsest features look wider than two pixels on level ground, nobody would see it.
scene::Grain ground_grain(const landscape::Ground& ground, const FrameView& view);

} // namespace octant::visuals::planning
