#pragma once

#include "sim/base/earth_frame.h"
#include "sim/base/geo_place.h"
#include "ui/settings/settings.h"
#include "ui/world/ground_texture_file.h"
#include "visuals/landscape/ground.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/ground_texture.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// The settings with what the ground decides where they leave it open: its colours, and the sun at
/// its place.
settings::RunSettings
ground_settings(const settings::RunSettings& settings, const std::optional<GeoPlace>& place);

/// The ground of a run, ready to be shared by its views.
struct SceneGround {
    std::shared_ptr<const visuals::landscape::Ground> ground;
    /// Null = the ground shows its vertices' colours.
    std::shared_ptr<const visuals::scene::GroundTexture> texture;
    /// With its size, for people.
    std::string name;
    /// Nothing for made ground.
    std::optional<GeoPlace> place;
    /// How it lies on the earth; null for made ground.
    std::shared_ptr<const EarthFrame> frame;
    /// What a person should be told.
    std::vector<std::string> notes;
};

/// Loads the ground of a run, whose settings have passed settings::check_settings. Throws Error for
/// what cannot be read.
SceneGround load_scene_ground(const settings::RunSettings& settings, DrawnBy drawn_by);

/// Ground and texture of a scene as these settings, which are ground_settings(), want them: made of
/// the heights in memory, in other colours or under another mesh. Terrain is not read again; an
/// image laid over it is. Nothing where the heights must be loaded. Throws Error for that image.
std::optional<SceneGround> remade_scene_ground(
    const visuals::planning::Scene& scene, const settings::RunSettings& settings, DrawnBy drawn_by);

} // namespace octant::ui::world
