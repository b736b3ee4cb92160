#pragma once

#include "visuals/planning/bounding_box.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>

namespace octant::visuals::planning {

/// The pixels that hold a box as FramePlan::world_to_view and view_to_clip show it; the whole
/// picture where part of the box lies behind the eye.
scene::PixelBox
pixel_box(const OrientedBox& box, const scene::FramePlan& plan, const glm::ivec2& size_px);

} // namespace octant::visuals::planning
