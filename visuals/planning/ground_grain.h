#pragma once

#include "visuals/scene/cover_contrast.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec3.hpp>

#include <memory>

namespace octant::visuals::planning {

/// Where the fine pattern lies on the ground of a frame.
scene::Grain
ground_grain(std::shared_ptr<const scene::CoverContrast> contrast, const glm::dvec3& eye_m);

} // namespace octant::visuals::planning
