#pragma once

#include "ui/settings/settings.h"
#include "visuals/scene/camera.h"

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
settings::Settings dragged(const settings::Settings& settings, const glm::vec2& share_of_height);

/// Settings after the wheel was turned so many clicks towards the screen.
settings::Settings zoomed(const settings::Settings& settings, double clicks);

/// Settings looking straight again.
settings::Settings looking_straight(const settings::Settings& settings);

/// Settings of another view, seen from the camera's place where it becomes the free one.
settings::Settings with_view(
    const settings::Settings& settings,
    visuals::scene::View view,
    const visuals::scene::Camera& camera);

/// The free camera `wall_s` later.
settings::Settings moved(const settings::Settings& settings, const FreeMove& move, double wall_s);

} // namespace octant::ui::window
