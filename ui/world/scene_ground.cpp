#include "ui/world/scene_ground.h"

#include "models/heights/height_field_import.h"
#include "models/heights/local_frame.h"
#include "models/heights/runway_strip.h"
#include "models/procedural/procedural_models.h"
#include "sim/base/error.h"
#include "ui/settings/terrain_name.h"
#include "ui/world/input_files.h"
#include "ui/world/sun_at_time.h"
#include "ui/world/terrain_file.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/terrain/ground_builder.h"

#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

namespace octant::ui::world {

namespace landscape = visuals::landscape;
namespace planning = visuals::planning;
namespace scene = visuals::scene;
namespace terrain = visuals::terrain;

using models::heights::HeightField;
using models::heights::RunwayStrip;

namespace {

void add_texture(const settings::RunSettings& settings, RenderDevice device, SceneGround& ground) {
    const std::optional<landscape::GroundTextureSource> source = ground.ground->source();
    std::optional<scene::GroundTexture> texture =
        source ? load_ground_texture(*source, settings, device, ground.notes) : std::nullopt;
    if (texture) { ground.texture = std::make_shared<const scene::GroundTexture>(std::move(*texture)); }
}

/// With its texture, and with what is to be said of it. The ground has a source.
SceneGround with_texture_and_notes(std::shared_ptr<const landscape::Ground> ground, std::int64_t filled_voids,
    const settings::RunSettings& settings, RenderDevice device) {
    SceneGround loaded;
    loaded.filled_voids = filled_voids;
    loaded.ground = std::move(ground);
    const landscape::GroundTextureSource source = loaded.ground->source().value();
    loaded.name = fmt::format("{}, {} x {} samples, {:.4g} m apart", source.area.name, source.samples.columns(),
        source.samples.rows(), source.samples.spacing_m());
    loaded.place = source.place;
    loaded.frame = models::heights::frame_of_ground(source.area.system, source.place);
    if (filled_voids > 0) {
        loaded.notes.push_back(
            fmt::format("{}: {} samples without data were filled in", source.area.name, filled_voids));
    }
    add_texture(settings, device, loaded);
    if (loaded.texture) { loaded.name += settings.air.drape ? ", draped" : ", textured"; }
    return loaded;
}

/// All heights of a ground, in memory.
HeightField field_of(const terrain::GroundTiles& tiles) {
    const terrain::GroundMetadata& metadata = tiles.metadata();
    std::vector<float> heights_m;
    heights_m.reserve(static_cast<std::size_t>(tiles.columns()) * static_cast<std::size_t>(tiles.rows()));
    for (int row = 0; row < tiles.rows(); ++row) {
        for (int column = 0; column < tiles.columns(); ++column) { heights_m.push_back(tiles.height_m(column, row)); }
    }
    HeightField field(tiles.columns(), tiles.rows(), tiles.spacing_m(), std::move(heights_m));
    field.name = metadata.name;
    field.place = metadata.place;
    field.system = metadata.system;
    field.filled_voids = metadata.filled_voids;
    return field;
}

/// Throws Error for more samples than are levelled in memory.
void check_samples(std::int64_t columns, std::int64_t rows) {
    constexpr std::int64_t most = std::int64_t{16385} * 16385;
    if (columns * rows > most) {
        throw Error(fmt::format("--airfield: expected at most {} samples of ground, got {} x {}", most, columns, rows));
    }
}

/// The ground of these heights, levelled where a runway is to be found.
SceneGround ground_of_field(
    HeightField field, const settings::RunSettings& settings, RenderDevice device, const RunwayFinder& find_runway) {
    std::vector<std::string> notes;
    for (const models::heights::MapNote& note : field.notes) { notes.push_back(note.text); }
    std::shared_ptr<const RunwayStrip> runway;
    if (find_runway) {
        check_samples(field.columns(), field.rows());
        runway = std::make_shared<const RunwayStrip>(find_runway(field, notes));
        field = models::heights::levelled(field, *runway);
    }
    const std::int64_t filled_voids = field.filled_voids;
    const settings::RunSettings own = with_ground_defaults(settings, field.place);
    SceneGround loaded = with_texture_and_notes(
        scene::ground_metric(settings.ground) == scene::GroundMetric::ScreenError
            ? landscape::make_bisection_ground(terrain::make_ground_tiles(field), own.air, runway)
            : landscape::make_quadtree_ground(std::move(field), own.ground, own.air, runway),
        filled_voids, own, device);
    loaded.notes.insert(loaded.notes.end(), notes.begin(), notes.end());
    return loaded;
}

SceneGround load_imported(const settings::RunSettings& settings, RenderDevice device, const RunwayFinder& find_runway) {
    terrain::GroundTiles ground = visuals::groundfile::open_ground(settings.path.terrain);
    if (find_runway) {
        check_samples(ground.columns(), ground.rows());
        return ground_of_field(field_of(ground), settings, device, find_runway);
    }
    const std::int64_t filled_voids = ground.metadata().filled_voids;
    const settings::RunSettings own = with_ground_defaults(settings, ground.metadata().place);
    return with_texture_and_notes(
        landscape::make_bisection_ground(std::move(ground), own.air), filled_voids, own, device);
}

SceneGround load_field(const settings::RunSettings& settings, RenderDevice device, const RunwayFinder& find_runway) {
    return ground_of_field(
        load_height_field(settings.path.terrain, import_options(settings.path)), settings, device, find_runway);
}

SceneGround load_polygons(const settings::RunSettings& settings) {
    SceneGround loaded;
    loaded.name = settings.path.terrain;
    loaded.ground = landscape::make_polygon_ground(
        settings.path.terrain == "none" ? models::polygons::PolygonModel{} : models::procedural::background60(),
        with_ground_defaults(settings, std::nullopt).air);
    return loaded;
}

} // namespace

settings::RunSettings with_ground_defaults(
    const settings::RunSettings& settings, const std::optional<GeoPosition>& place) {
    settings::RunSettings own = with_sun_at_time(settings, place);
    if (!settings.air.palette && settings.path.terrain == "canyon") { own.air.palette = scene::Palette::Arid; }
    return own;
}

TerrainSources terrain_sources(const settings::PathSettings& settings) {
    TerrainSources inputs{.terrain = settings.terrain, .options = import_options(settings), .files = {}};
    for (const std::filesystem::path& file : ground_files(settings.terrain)) { add_mtime(file, inputs.files); }
    std::error_code none;
    const std::optional<std::string>& system = inputs.options.system;
    if (system && std::filesystem::is_regular_file(*system, none)) { add_mtime(*system, inputs.files); }
    return inputs;
}

std::optional<SceneGround> shared_scene_ground(
    const SceneGround& other, const settings::RunSettings& settings, RenderDevice device) {
    if (terrain_sources(settings.path) != other.inputs) { return std::nullopt; }
    const settings::RunSettings own = with_ground_defaults(settings, other.place);
    std::shared_ptr<const landscape::Ground> ground = other.ground->matches_settings(own.ground, own.air)
                                                          ? other.ground
                                                          : other.ground->with_settings(own.ground, own.air);
    if (!ground || !ground->source()) { return std::nullopt; }
    SceneGround shared = with_texture_and_notes(std::move(ground), other.filled_voids, own, device);
    shared.inputs = other.inputs;
    return shared;
}

std::optional<SceneGround> rebuilt_scene_ground(
    const planning::Scene& scene, const settings::RunSettings& settings, RenderDevice device) {
    SceneGround with_settings;
    with_settings.ground = scene.ground->with_settings(settings.ground, settings.air);
    if (!with_settings.ground) { return std::nullopt; }
    if (scene.ground_texture) { add_texture(settings, device, with_settings); }
    return with_settings;
}

SceneGround load_scene_ground(
    const settings::RunSettings& settings, RenderDevice device, const RunwayFinder& find_runway) {
    models::heights::check_coordinate_system(import_options(settings.path));
    if (settings::has_no_detail_levels(settings.path.terrain)) {
        if (find_runway) {
            throw Error(
                fmt::format("--airfield: expected ground that can be levelled, got '{}'", settings.path.terrain));
        }
        return load_polygons(settings);
    }
    // What is written while heights are read makes them old.
    TerrainSources inputs = terrain_sources(settings.path);
    SceneGround ground = settings::is_imported_ground(settings.path.terrain)
                             ? load_imported(settings, device, find_runway)
                             : load_field(settings, device, find_runway);
    ground.inputs = std::move(inputs);
    return ground;
}

} // namespace octant::ui::world
