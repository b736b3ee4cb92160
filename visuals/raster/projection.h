#pragma once

#include "visuals/raster/screen_vertex.h"
#include "visuals/scene/frame_plan.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace octant::visuals::raster {

/// From world axes with the eye subtracted to places in a picture.
struct Projection {
    glm::mat4 world_to_clip{1.0F};
    glm::vec2 half_px{0.0F}; ///< half of the picture's size
    float near_m = 0.0F;     ///< what has a smaller w is cut off
    /// Clip coordinates x and y of a placed corner are at most this many times w.
    glm::vec2 max_over_w{0.0F};
    glm::ivec2 size_px{0};
};

/// For pictures of at most 8,192 pixels each way.
Projection projection_of(const scene::FramePlan& plan, const glm::ivec2& size_px);

ClipPosition clip_position(const Projection& projection, const glm::vec3& position_m);

/// Fills in all but the values.
void place(const Projection& projection, const ClipPosition& clip, ScreenVertex& vertex);

/// exp(-x) for x >= 0, by sums and products alone, so that all processors agree. Relative error below 4e-6: that of the
/// product x * log2(e) at x = 80, where nothing is left to see.
float exp_of_minus(float x);

} // namespace octant::visuals::raster
