#pragma once

#include "visuals/scene/land_cover_contrast.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec3.hpp>

#include <memory>

namespace octant::visuals::planning {

/// Where the fine pattern lies on the ground of a frame.
scene::DetailTexture
ground_detail_texture(std::shared_ptr<const scene::LandCoverContrast> contrast, const glm::dvec3& eye_m);

} // namespace octant::visuals::planning
