#pragma once

#include "visuals/overlay/overlay_canvas.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <string_view>

namespace octant::visuals::overlay {

/// A name at a place of the world; eye at the origin.
struct WorldLabel {
    glm::dvec3 at_m{0.0};
    std::string_view name;
};

/// What lies beside a path in the picture: names at their places, a scale for what is as far as the aircraft, and a
/// mark that points north.
class PathAnnotations {
public:
    /// Begins a picture; `aircraft_m` off the eye.
    void begin(const scene::Camera& camera, const glm::ivec2& size_px, const glm::dvec3& aircraft_m);

    /// Writes a name where its place is in the picture, if that is before the eye and in view.
    void add(const WorldLabel& place);

    /// Valid until the next begin(). No allocation once warmed up.
    scene::OverlayDraw finish();

private:
    void draw_north(const glm::vec2& centre_px);
    void draw_scale(const glm::vec2& from_px);

    OverlayCanvas canvas_;
    scene::Camera camera_;
    glm::vec2 size_px_{1.0F};
    float letter_px_ = 8.0F;
    double focal_px_ = 1.0;
    double aircraft_m_ = 1.0; ///< how far it is off
};

} // namespace octant::visuals::overlay
