#include "visuals/raster/projection.h"

#include <cmath>
#include <cstdint>

namespace octant::visuals::raster {

namespace {

constexpr float farthest_px = 16000.0F; ///< of a placed corner from the picture's middle

} // namespace

Projection projection_of(const scene::FramePlan& plan, const glm::ivec2& size_px) {
    Projection projection;
    projection.world_to_clip = plan.view_to_clip * plan.world_to_view;
    projection.size_px = size_px;
    projection.half_px = glm::vec2(size_px) * 0.5F;
    projection.near_m = plan.view_to_clip[3][2];
    projection.max_over_w = glm::vec2(farthest_px) / projection.half_px;
    return projection;
}

void place(const Projection& projection, const ClipPosition& clip, ScreenVertex& vertex) {
    vertex.outcode = (clip.x < -clip.w ? left_of_view : 0U) | (clip.x > clip.w ? right_of_view : 0U) |
                     (clip.y > clip.w ? above_view : 0U) | (clip.y < -clip.w ? below_view : 0U);
    const glm::vec2 max = projection.max_over_w * clip.w;
    // Written so that what is no number counts as unplaced.
    if (!(clip.w >= projection.near_m && std::abs(clip.x) <= max.x && std::abs(clip.y) <= max.y)) {
        vertex.outcode |= beyond_range;
        return;
    }
    vertex.inverse_w = 1.0F / clip.w;
    const float x_px = clip.x * vertex.inverse_w * projection.half_px.x + projection.half_px.x;
    const float y_px = projection.half_px.y - clip.y * vertex.inverse_w * projection.half_px.y;
    constexpr auto steps = static_cast<float>(ScreenVertex::per_px);
    const auto rounded = [](float value) { return static_cast<std::int32_t>(value + (value < 0.0F ? -0.5F : 0.5F)); };
    vertex.x = rounded((x_px - 0.5F) * steps);
    vertex.y = rounded((y_px - 0.5F) * steps);
}

} // namespace octant::visuals::raster
