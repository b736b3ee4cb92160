#pragma once

#include "ui/settings/settings.h"
#include "visuals/scene/settings.h"

namespace octant::ui::settings {

// Checks of settings that need nothing else, such as the world that is loaded for them.

/// Throws Error where settings contradict each other or a number is not one of those that its setting takes. Reads the
/// first bytes of a terrain file.
void check_settings(const RunSettings& settings);

/// Throws Error for eye points that the view does not take. check_settings() includes it.
void check_eye_point(const visuals::scene::ViewSettings& view);

} // namespace octant::ui::settings
