#pragma once

#include "models/heights/height_field.h"
#include "ui/settings/settings.h"
#include "ui/world/ground_texture_file.h"
#include "visuals/scene/ground.h"
#include "visuals/scene/ground_texture.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// Throws Error for settings of the ground that do not go together.
void check_ground_settings(const settings::Settings& settings);

/// Ground of polygons: there is no detail to choose.
bool is_drawn_whole(const std::string& terrain);

/// The settings with what the ground decides where they leave it open: its colours.
settings::Settings ground_settings(const settings::Settings& settings);

/// The ground of a run, ready to be shared by its views.
struct SceneGround {
    std::shared_ptr<const visuals::scene::Ground> ground;
    /// Null = the ground shows its vertices' colours.
    std::shared_ptr<const visuals::scene::GroundTexture> texture;
    std::string name;                               ///< with its size, for people
    std::optional<models::heights::GeoPlace> place; ///< nothing for made ground
    std::vector<std::string> notes;                 ///< what a person should be told
};

/// Loads the ground of a run. Throws Error for what cannot be read and for settings that do not go
/// together.
SceneGround load_scene_ground(const settings::Settings& settings, DrawnBy drawn_by);

} // namespace octant::ui::world
