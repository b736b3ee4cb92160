#include "visuals/raster/grain_image.h"

#include "visuals/scene/grain_pattern.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <cassert>
#include <cstddef>

namespace octant::visuals::raster {

namespace {

using scene::GrainPattern;

/// Bytes behind a row that may be loaded with its last texel.
constexpr int behind_row = 4;
constexpr int least_side = 4;

GrainImage::Level level_of(const GrainPattern& pattern) {
    GrainImage::Level level{pattern.size, pattern.size + behind_row, {}};
    const auto size = static_cast<std::size_t>(level.size);
    level.texels.reserve(size * static_cast<std::size_t>(level.stride));
    for (std::size_t row = 0; row < size; ++row) {
        for (std::size_t column = 0; column < static_cast<std::size_t>(level.stride); ++column) {
            level.texels.push_back(pattern.texels[row * size + column % size]);
        }
    }
    return level;
}

/// A part of the world direction of each pixel's line of sight, one unit deep: `of_view` has that
/// part of the directions right, up and backwards.
RealPlane
ray_part(const glm::dvec3& of_view, const glm::dmat4& view_to_clip, const glm::dvec2& half_px) {
    const double across = 1.0 / view_to_clip[0][0];
    const double up = 1.0 / view_to_clip[1][1];
    RealPlane plane;
    plane.per_x = of_view.x * across / half_px.x;
    plane.per_y = -of_view.y * up / half_px.y;
    // The picture's middle need not lie straight ahead.
    plane.base = of_view.x * across * (view_to_clip[2][0] - 1.0) +
                 of_view.y * up * (view_to_clip[2][1] + 1.0) - of_view.z +
                 0.5 * (plane.per_x + plane.per_y);
    return plane;
}

} // namespace

GrainImage::GrainImage() {
    GrainPattern pattern = scene::grain_pattern();
    levels_.push_back(level_of(pattern));
    while (pattern.size > least_side) {
        pattern = half_of(pattern);
        levels_.push_back(level_of(pattern));
    }
}

const GrainImage& grain_image() {
    static const GrainImage image;
    return image;
}

GrainRays grain_rays(const scene::FramePlan& plan, const Projection& projection) {
    assert(plan.grain);
    const glm::dmat3 world_to_view(glm::mat3(plan.world_to_view));
    const glm::dmat4 view_to_clip(plan.view_to_clip);
    const glm::dvec2 half_px(projection.half_px);
    const auto per_m = static_cast<double>(GrainPattern::texels_per_m);
    const glm::dvec2 lean(GrainPattern::lean);
    // Columns of world_to_view: what the world's axes are in the view's.
    const glm::dvec3 east = (world_to_view[0] + lean.x * world_to_view[2]) * per_m;
    const glm::dvec3 north = (world_to_view[1] + lean.y * world_to_view[2]) * per_m;
    return {
        ray_part(east, view_to_clip, half_px),
        ray_part(north, view_to_clip, half_px),
        glm::dvec2(plan.grain->at_eye) * static_cast<double>(GrainPattern::texels_a_side)};
}

} // namespace octant::visuals::raster
