#pragma once

#include "visuals/scene/camera.h"
#include "visuals/scene/settings.h"

#include <glm/vec2.hpp>

namespace octant::ui::window {

/// Which way the free camera is asked to move, each -1, 0 or 1, in its own axes.
struct FreeMove {
    int right = 0;
    int up = 0;
    int ahead = 0;
    bool fast = false;
};

/// Settings after the pointer was dragged so far: the look turned, or the eye around the aircraft.
/// Dragging right shows more of what is on the left, as a map is dragged.
visuals::scene::Settings
dragged(const visuals::scene::Settings& settings, const glm::vec2& share_of_height);

/// Settings after the wheel was turned so many clicks towards the screen.
visuals::scene::Settings zoomed(const visuals::scene::Settings& settings, double clicks);

/// Settings looking straight again.
visuals::scene::Settings looking_straight(const visuals::scene::Settings& settings);

/// Settings of another view, seen from the camera's place where it becomes the free one.
visuals::scene::Settings with_view(
    const visuals::scene::Settings& settings,
    visuals::scene::View view,
    const visuals::scene::Camera& camera);

/// The free camera `wall_s` later.
visuals::scene::Settings
moved(const visuals::scene::Settings& settings, const FreeMove& move, double wall_s);

} // namespace octant::ui::window
