#pragma once

#include "models/heights/height_field.h"
#include "models/heights/runway_strip.h"
#include "sim/base/earth_frame.h"
#include "ui/settings/settings.h"
#include "ui/world/height_loader.h"
#include "visuals/landscape/ground.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// 45 degrees north for ground without a place.
double latitude_of(const std::optional<GeoPosition>& place);

/// The settings with the sun where it stands at their time and that place, on the horizon at night; the same settings
/// where they name no time, which has passed settings::check_settings.
settings::RunSettings with_sun_at_time(settings::RunSettings settings, const std::optional<GeoPosition>& place);

/// As with_sun_at_time(), for settings that change from `before`: where the sun was moved by hand (the sun differs, the
/// time does not), the time is cleared.
settings::RunSettings with_sun_updated(
    settings::RunSettings settings, const settings::RunSettings& before, const std::optional<GeoPosition>& place);

/// Notes on the sun of the settings' time: that it is the earth's, over another planet, or below the horizon.
std::vector<std::string> sun_notes(const settings::RunSettings& settings, const std::optional<GeoPosition>& place);

/// A note where the eye point lies under the ground, whose height there is `ground_m`; nothing where it does not.
std::optional<std::string> low_eye_note(const glm::dvec3& eye_m, const std::optional<double>& ground_m);

/// Who draws: decides whether the setting ground-shading auto uses a texture.
enum class RenderDevice { Cpu, Gpu };

/// The texture of the ground; nothing where it is drawn by its vertices' colours. Appends notes for the user. The
/// settings have passed settings::check_settings. Throws Error for a drape that cannot be read or laid over the ground.
std::optional<visuals::scene::GroundTexture> load_ground_texture(const visuals::landscape::GroundTextureSource& ground,
    const settings::RunSettings& settings, RenderDevice device, std::vector<std::string>& notes);

/// The settings with what the ground decides where they leave it open: its colours, and the sun at its place.
settings::RunSettings with_ground_defaults(
    const settings::RunSettings& settings, const std::optional<GeoPosition>& place);

/// Facts about the ground of a run that its shape does not tell.
struct GroundInfo {
    TerrainSources inputs;
    /// Number of samples of the heights that had no data.
    std::int64_t filled_voids = 0;
    /// With its size, for people.
    std::string name;
    /// Where it lies on the earth; nothing for generated ground.
    std::optional<GeoPosition> place;
    /// How it lies on the earth; null for generated ground.
    std::shared_ptr<const EarthFrame> frame;
};

/// The ground of a run, ready to be shared by its views.
struct SceneGround {
    GroundInfo info;
    std::shared_ptr<const visuals::landscape::Ground> ground;
    /// Null = the ground shows its vertices' colours.
    std::shared_ptr<const visuals::scene::GroundTexture> texture;
    /// Notes for the user.
    std::vector<std::string> notes;
};

/// Finds a runway on these heights and appends notes for the user. Throws Error where none fits.
using RunwayFinder = std::function<models::heights::RunwayStrip(
    const models::heights::HeightField& field, std::vector<std::string>& notes)>;

/// Loads the ground of a run, whose settings have passed settings::check_settings. Throws Error for what cannot be
/// read. `find_runway`: the heights are levelled for the runway that it finds; Error for ground that has no heights to
/// be levelled, or more than are levelled.
SceneGround load_scene_ground(
    const settings::RunSettings& settings, RenderDevice device, const RunwayFinder& find_runway = nullptr);

/// The ground of a run whose heights another run has in memory: the same object if these settings mesh and colour it
/// alike, else made of the same heights. Nothing if it must be loaded. Throws Error for an image to be laid over it.
std::optional<SceneGround> shared_scene_ground(const GroundInfo& info,
    const std::shared_ptr<const visuals::landscape::Ground>& ground, const settings::RunSettings& settings,
    RenderDevice device);

/// Ground and texture of the same scene for changed settings, which are with_ground_defaults(): made of the heights in
/// memory, in other colours or with another mesh. Only an image that is laid over the ground is read again; Error if it
/// cannot be. Nothing if the heights must be loaded.
std::optional<SceneGround> rebuilt_scene_ground(
    const visuals::planning::Scene& scene, const settings::RunSettings& settings, RenderDevice device);

} // namespace octant::ui::world
