#pragma once

#include "sim/base/thread_pool.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/picture.h"

#include <glm/vec2.hpp>

#include <span>

namespace octant::visuals::raster {

/// Shows how a tile is painted, the one in the middle, when half of its samples are covered. Each pixel is a square of
/// 16 x 16, each of its samples a dot at its place: in the colour of the triangle that covers it, one hue each, or grey
/// where none does yet. The plan must be without a ground texture (asserted).
scene::Picture mask_picture(const scene::FramePlan& plan, std::span<const scene::ModelBuffers> models,
    const glm::ivec2& size_px, ThreadPool& workers);

} // namespace octant::visuals::raster
