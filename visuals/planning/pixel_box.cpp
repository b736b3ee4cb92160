#include "visuals/planning/pixel_box.h"

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <limits>

namespace octant::visuals::planning {

namespace {

/// The share of the box's size that must lie before the eye.
constexpr double nearest = 1e-6;

} // namespace

scene::PixelBox
pixel_box(const OrientedBox& box, const scene::FramePlan& plan, const glm::ivec2& size_px) {
    const glm::dmat4 world_to_clip = glm::dmat4(plan.view_to_clip) * glm::dmat4(plan.world_to_view);
    const glm::dvec2 size(size_px);
    glm::dvec2 least(std::numeric_limits<double>::max());
    glm::dvec2 most(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& corner_m : corners_of(box)) {
        const glm::dvec4 clip = world_to_clip * glm::dvec4(corner_m, 1.0);
        if (clip.w <= nearest * radius_m(box)) {
            return {glm::ivec2(0), size_px};
        }
        const glm::dvec2 at = glm::dvec2(clip.x, -clip.y) / clip.w;
        least = glm::min(least, at);
        most = glm::max(most, at);
    }
    const auto in_pixels = [&](const glm::dvec2& at) { return (at * 0.5 + 0.5) * size; };
    const glm::dvec2 from = glm::clamp(glm::floor(in_pixels(least)), glm::dvec2(0.0), size);
    const glm::dvec2 to = glm::clamp(glm::ceil(in_pixels(most)), glm::dvec2(0.0), size);
    return {glm::ivec2(from), glm::ivec2(to)};
}

} // namespace octant::visuals::planning
