#include "visuals/raster/projection.h"

#include <bit>
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

ClipPosition clip_position(const Projection& projection, const glm::vec3& position_m) {
    const glm::mat4& m = projection.world_to_clip;
    const auto row = [&](glm::length_t i) {
        return m[0][i] * position_m.x + m[1][i] * position_m.y + m[2][i] * position_m.z + m[3][i];
    };
    return {row(0), row(1), row(3)};
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

float exp_of_minus(float x) {
    constexpr float log2_of_e = 1.44269504F;
    constexpr float max = 126.0F;
    const float power = x * log2_of_e < max ? x * log2_of_e : max;
    const auto whole = static_cast<std::int32_t>(power);
    const float part = power - static_cast<float>(whole); // 0..1
    // 2^-part: the Taylor series of exp(-part * ln 2) about part = 1/2.
    const float t = (0.5F - part) * 0.693147181F;
    float series = 1.0F;
    for (const float order : {7.0F, 6.0F, 5.0F, 4.0F, 3.0F, 2.0F, 1.0F}) { series = 1.0F + t / order * series; }
    const float half_power = 0.707106781F * series;
    return half_power * std::bit_cast<float>((127 - whole) << 23);
}

} // namespace octant::visuals::raster
