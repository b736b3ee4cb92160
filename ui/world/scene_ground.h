#pragma once

#include "models/heights/height_field.h"
#include "models/heights/import_options.h"
#include "models/heights/runway_strip.h"
#include "sim/base/earth_frame.h"
#include "ui/settings/settings.h"
#include "ui/world/input_files.h"
#include "visuals/landscape/ground.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/ground_texture.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::world {

/// Built-in ground by name, "hills" or "canyon", as models::procedural::procedural_terrain makes it; nothing for
/// another name. It is kept in the user's cache, and read from there in a twentieth of the time. A file that is damaged
/// or of another version is replaced; a cache that cannot be made, read or written is done without.
std::optional<models::heights::HeightField> built_in_ground(std::string_view name);

/// A height field by name: hills, canyon, or maps that GDAL reads, as models::heights::map_inputs takes them. Throws
/// Error for a name that is neither, listing the built-in ones.
models::heights::HeightField load_height_field(
    const std::string& name_or_file, const models::heights::ImportOptions& options);

/// What a person should be told who asks for more triangles than the samples of a ground make; nothing where they
/// suffice. `option`: one that cures it.
std::optional<std::string> few_samples_note(
    const std::string& name, const glm::ivec2& samples, int asked_triangles, const std::string& option);

/// What a person should be told whose eye point lies under the ground, which is so high there; nothing where it does
/// not.
std::optional<std::string> low_eye_note(const glm::dvec3& eye_m, const std::optional<double>& ground_m);

/// What settings say of files that do not say it themselves.
models::heights::ImportOptions import_options(const settings::PathSettings& settings);

/// What decides whether a texture is worth its time where the settings leave it open.
enum class RenderDevice { Cpu, Gpu };

/// The texture of the ground; nothing where it is drawn by its vertices' colours. What a person should be told goes to
/// `notes`. The settings have passed settings::check_settings. Throws Error for a drape that cannot be read or laid
/// over the ground.
std::optional<visuals::scene::GroundTexture> load_ground_texture(const visuals::landscape::GroundTextureSource& ground,
    const settings::RunSettings& settings, RenderDevice device, std::vector<std::string>& notes);

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
