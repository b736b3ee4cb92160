#pragma once

#include "ui/settings/settings.h"
#include "visuals/scene/camera.h"

#include <glm/vec2.hpp>

namespace octant::ui::window {

/// The directions in which the free camera is asked to move, each -1, 0 or 1, in its own axes.
struct FreeMove {
    int right = 0;
    int up = 0;
    int ahead = 0;
    bool fast = false;
};

/// Returns the settings after the pointer was dragged by these shares of the picture's height. The direction of view
/// turns, or the eye moves around the aircraft. Dragging right shows more of what is on the left, as a map is dragged.
settings::RunSettings dragged(const settings::RunSettings& settings, const glm::vec2& share_of_height);

/// Returns the settings after the wheel was turned by `clicks` towards the screen.
settings::RunSettings zoomed(const settings::RunSettings& settings, double clicks);

/// Returns the settings with the view turned straight ahead and a zoom of 1.
settings::RunSettings with_straight_look(const settings::RunSettings& settings);

/// Returns the settings with another view. A view that becomes the free one begins at the place of `camera`.
settings::RunSettings with_view(
    const settings::RunSettings& settings, visuals::scene::View view, const visuals::scene::Camera& camera);

/// Returns the settings after the free camera moved for `wall_s` seconds.
settings::RunSettings moved(const settings::RunSettings& settings, const FreeMove& move, double wall_s);

} // namespace octant::ui::window
