#pragma once

#include "ui/settings/settings.h"
#include "ui/world/ground_texture_file.h"
#include "ui/world/world.h"

#include <string>

namespace octant::ui::world {

/// Throws Error for settings of the ground that do not go together.
void check_ground_settings(const settings::Settings& settings);

/// Ground of polygons: there is no detail to choose.
bool is_drawn_whole(const std::string& terrain);

/// The settings with what the ground decides where they leave it open: its colours.
settings::Settings ground_settings(const settings::Settings& settings);

/// Loads the ground of a run into World::scene, and what is to be said of it into World. Throws
/// Error for what cannot be read and for settings that do not go together.
void load_scene_ground(const settings::Settings& settings, DrawnBy drawn_by, World& world);

} // namespace octant::ui::world
