#include "visuals/raster/detail_rays.h"

#include "visuals/scene/detail_pattern.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <cassert>
#include <cmath>
#include <cstddef>

namespace octant::visuals::raster {

namespace {

using scene::DetailPattern;

/// The part along an axis of each pixel's line of sight, one unit deep: `of_view` has that part of the directions
/// right, up and backwards.
AttributePlane ray_part(const glm::dvec3& of_view, const glm::dmat4& view_to_clip, const glm::dvec2& half_px) {
    const double across = 1.0 / view_to_clip[0][0];
    const double up = 1.0 / view_to_clip[1][1];
    AttributePlane plane;
    plane.per_x = of_view.x * across / half_px.x;
    plane.per_y = -of_view.y * up / half_px.y;
    // The picture's middle need not lie straight ahead.
    plane.base = of_view.x * across * (view_to_clip[2][0] - 1.0) + of_view.y * up * (view_to_clip[2][1] + 1.0) -
                 of_view.z + 0.5 * (plane.per_x + plane.per_y);
    return plane;
}

} // namespace

DetailRays detail_rays(const scene::FramePlan& plan, const Projection& projection) {
    assert(plan.detail_texture && plan.detail_texture->contrast);
    const glm::dmat3 world_to_view(glm::mat3(plan.world_to_view));
    const glm::dmat4 view_to_clip(plan.view_to_clip);
    const glm::dvec2 half_px(projection.half_px);
    DetailRays rays;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const glm::dvec3& in_world = DetailPattern::axes[axis];
        rays.direction[axis] = ray_part(world_to_view * in_world, view_to_clip, half_px);
        rays.up[axis] = static_cast<float>(in_world.z);
    }
    const auto texels_per_m = static_cast<float>(scene::detail_texels_per_m(view_to_clip[1][1] * half_px.y));
    rays.texels2_per_m2 = texels_per_m * texels_per_m;
    constexpr auto parts_a_texel = 256.0F;
    constexpr auto parts_a_tile = parts_a_texel * DetailPattern::side_texels;
    for (std::size_t scale = 0; scale < rays.scales.size(); ++scale) {
        const float texels_per_m_of_scale =
            std::ldexp(DetailPattern::texels_per_m, -DetailPattern::levels_per_scale * static_cast<int>(scale));
        const glm::vec3& in_next = plan.detail_texture->at_eye[scale + 1];
        rays.scales[scale] = {
            in_next * (DetailPattern::scale_step * parts_a_tile), parts_a_texel * texels_per_m_of_scale};
    }
    const scene::Haze& haze = plan.haze;
    rays.haze_per_m = haze.visibility_m > 0.0F ? 1.0F / haze.visibility_m : 0.0F;
    rays.haze_falloff_per_m = haze.falloff_per_m;
    rays.contrast = plan.detail_texture->contrast->table().data();
    rays.texels = plan.detail_texture->contrast->pattern().texels();
    return rays;
}

} // namespace octant::visuals::raster
