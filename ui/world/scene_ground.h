#pragma once

#include "ui/settings/settings.h"
#include "ui/world/ground_texture_file.h"
#include "ui/world/world.h"

namespace octant::ui::world {

/// The settings with what the ground decides where they leave it open: its colours.
settings::Settings ground_settings(const settings::Settings& settings);

/// Loads the ground of a run into World::scene, and what is to be said of it into World. The
/// settings have passed settings::check_settings. Throws Error for what cannot be read and for a
/// texture on ground that has none.
void load_scene_ground(const settings::Settings& settings, DrawnBy drawn_by, World& world);

} // namespace octant::ui::world
