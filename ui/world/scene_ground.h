#pragma once

#include "models/heights/height_field.h"
#include "models/heights/import_options.h"
#include "models/heights/runway_strip.h"
#include "sim/base/earth_frame.h"
#include "sim/base/geo_position.h"
#include "ui/settings/settings.h"
#include "ui/world/file_mtimes.h"
#include "ui/world/ground_texture_file.h"
#include "visuals/landscape/ground.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/ground_texture.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// The settings with what the ground decides where they leave it open: its colours, and the sun at its place.
settings::RunSettings with_ground_defaults(
    const settings::RunSettings& settings, const std::optional<GeoPosition>& place);

/// What the heights of a ground are loaded of.
struct TerrainSources {
    /// As PathSettings has them.
    std::string terrain;
    models::heights::ImportOptions options;
    /// All files that the heights and their system come from; none for made ground.
    std::vector<FileMtime> files;

    bool operator==(const TerrainSources&) const = default;
};

/// Throws Error where there are no such files.
TerrainSources terrain_sources(const settings::PathSettings& settings);

/// The ground of a run, ready to be shared by its views.
struct SceneGround {
    TerrainSources inputs;
    /// How many samples of the heights had no data.
    std::int64_t filled_voids = 0;
    std::shared_ptr<const visuals::landscape::Ground> ground;
    /// Null = the ground shows its vertices' colours.
    std::shared_ptr<const visuals::scene::GroundTexture> texture;
    /// With its size, for people.
    std::string name;
    /// Nothing for made ground.
    std::optional<GeoPosition> place;
    /// How it lies on the earth; null for made ground.
    std::shared_ptr<const EarthFrame> frame;
    /// What a person should be told.
    std::vector<std::string> notes;
};

/// Says where a runway lies on these heights, with notes for people. Throws Error where none can.
using RunwayFinder = std::function<models::heights::RunwayStrip(
    const models::heights::HeightField& field, std::vector<std::string>& notes)>;

/// Loads the ground of a run, whose settings have passed settings::check_settings. Throws Error for what cannot be
/// read. `find_runway`: the heights are levelled for the runway that it finds; Error for ground that has no heights to
/// be levelled, or more than are levelled.
SceneGround load_scene_ground(
    const settings::RunSettings& settings, RenderDevice device, const RunwayFinder& find_runway = nullptr);

/// The ground of a run whose heights another run has in memory: as it is there where these settings mesh and colour it
/// alike. Nothing where it must be loaded. Throws Error for an image to be laid over it. `other` needs inputs, ground,
/// place and filled voids only.
std::optional<SceneGround> shared_scene_ground(
    const SceneGround& other, const settings::RunSettings& settings, RenderDevice device);

/// Ground and texture of a scene as these settings, which are with_ground_defaults(), want them: made of the heights in
/// memory, in other colours or under another mesh. Terrain is not read again; an image laid over it is. Nothing where
/// the heights must be loaded. Throws Error for that image.
std::optional<SceneGround> rebuilt_scene_ground(
    const visuals::planning::Scene& scene, const settings::RunSettings& settings, RenderDevice device);

} // namespace octant::ui::world
