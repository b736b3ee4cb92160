#pragma once

#include "visuals/planning/bounding_box.h"
#include "visuals/scene/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace octant::visuals::planning {

/// From where one frame is seen and what follows from that.
struct FrameView {
    scene::Camera camera;
    glm::ivec2 size_px{1};
    double aspect = 1.0;
    /// The angle that a pixel covers in the middle of the picture.
    double pixel_rad = 0.001;
    /// The sides of the view as scene::frustum_normals gives them.
    std::array<glm::dvec3, 4> frustum{};
    /// The radius of the earth by which what is far sinks; 0 for a flat one.
    double earth_radius_m = 0.0;
};

FrameView frame_view(const scene::Camera& camera, const glm::ivec2& size_px, double earth_radius_m);

/// False only for a box of which nothing is in view.
bool in_view(const OrientedBox& box, const FrameView& view);

} // namespace octant::visuals::planning
