#include "visuals/overlay/head_up_glass.h"

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace octant::visuals::overlay {

namespace {

constexpr double min_ahead = 0.17; ///< cosine of 80 degrees

/// Pictures narrower than this show signs as small as those of a picture of this shape.
constexpr double narrowest_aspect = 1.0;

} // namespace

HudGlass make_hud_glass(const sim::AircraftState& state, const scene::Camera& camera, const glm::ivec2& size_px) {
    const glm::dvec2 size(size_px);
    HudGlass glass;
    glass.focal_px = 0.5 * size.y / std::tan(0.5 * camera.vertical_fov_rad);
    glass.unit_px = static_cast<float>(std::min(size.y, size.x / narrowest_aspect));
    glass.world_to_body = glm::conjugate(state.body_to_world);
    const glm::dmat3 body_to_view = glm::mat3_cast(glm::conjugate(camera.view_to_world) * state.body_to_world);
    const glm::dmat3 glass_to_body(glm::dvec3(0.0, 1.0 / glass.focal_px, 0.0),
        glm::dvec3(0.0, 0.0, 1.0 / glass.focal_px), glm::dvec3(1.0, 0.0, 0.0));
    const glm::dvec2 focal_px(glass.focal_px / camera.pixel_aspect, -glass.focal_px);
    const glm::dvec2 ahead_px = 0.5 * size - focal_px * camera.middle;
    const glm::dmat3 view_to_picture(
        glm::dvec3(focal_px.x, 0.0, 0.0), glm::dvec3(0.0, focal_px.y, 0.0), -glm::dvec3(ahead_px, 1.0));
    glass.to_picture = glm::mat3(view_to_picture * body_to_view * glass_to_body);
    return glass;
}

std::optional<glm::vec2> HudGlass::project(const glm::dvec3& world_direction) const {
    const glm::dvec3 in_body = world_to_body * world_direction;
    if (in_body.x <= min_ahead * glm::length(in_body)) { return std::nullopt; }
    return glm::vec2(glm::dvec2(in_body.y, in_body.z) * (focal_px / in_body.x));
}

glm::dvec3 HudGlass::direction_to(const glm::vec2& place) const {
    return glm::conjugate(world_to_body) *
           glm::dvec3(focal_px, static_cast<double>(place.x), static_cast<double>(place.y));
}

bool HudGlass::may_show(const OverlayBox& box, const glm::ivec2& size_px) const {
    glm::vec2 min_px(std::numeric_limits<float>::max());
    glm::vec2 max_px(std::numeric_limits<float>::lowest());
    for (const glm::vec2& corner :
        {box.min, glm::vec2(box.max.x, box.min.y), box.max, glm::vec2(box.min.x, box.max.y)}) {
        const glm::vec3 seen = to_picture * glm::vec3(corner, 1.0F);
        if (seen.z < static_cast<float>(min_ahead)) { return false; }
        min_px = glm::min(min_px, glm::vec2(seen) / seen.z);
        max_px = glm::max(max_px, glm::vec2(seen) / seen.z);
    }
    return max_px.x > 0.0F && max_px.y > 0.0F && min_px.x < static_cast<float>(size_px.x) &&
           min_px.y < static_cast<float>(size_px.y);
}

} // namespace octant::visuals::overlay
