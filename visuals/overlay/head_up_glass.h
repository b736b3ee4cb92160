#pragma once

#include "sim/aircraft_state.h"
#include "visuals/overlay/overlay_canvas.h"
#include "visuals/scene/camera.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace octant::visuals::overlay {

/// The glass that a head-up display is drawn on: a plane ahead of the pilot's eye, square to the body's x axis, which
/// meets it at (0, 0). x to the right wing, y down, in pixels as the picture has them where the pilot looks along that
/// axis; a look aside shows the plane in perspective.
struct HudGlass {
    double focal_px = 1.0;  ///< distance of the glass from the eye
    float unit_px = 720.0F; ///< what the sizes of its signs are shares of
    glm::dquat world_to_body{1.0, 0.0, 0.0, 0.0};
    glm::mat3 to_picture{1.0F}; ///< as OverlayCanvas::begin takes it

    /// Where a direction of the world meets the glass; nothing for those more than 80 degrees off the body's axis.
    std::optional<glm::vec2> project(const glm::dvec3& world_direction) const;

    /// The direction of the world that is seen at a place of the glass; not of unit length.
    glm::dvec3 direction_to(const glm::vec2& place) const;

    /// Whether the picture may show something of a box of the glass, all of it before the eye.
    bool may_show(const OverlayBox& box, const glm::ivec2& size_px) const;
};

HudGlass make_hud_glass(const sim::AircraftState& state, const scene::Camera& camera, const glm::ivec2& size_px);

} // namespace octant::visuals::overlay
