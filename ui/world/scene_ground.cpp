#include "ui/world/scene_ground.h"

#include "models/heights/height_field_import.h"
#include "models/heights/map_frame.h"
#include "models/heights/runway_strip.h"
#include "models/made/made_up.h"
#include "sim/base/error.h"
#include "ui/settings/terrain_name.h"
#include "ui/world/input_files.h"
#include "ui/world/sun_of_time.h"
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

void add_texture(const settings::RunSettings& settings, DrawnBy drawn_by, SceneGround& ground) {
    const std::optional<landscape::GroundSource> source = ground.ground->source();
    std::optional<scene::GroundTexture> texture =
        source ? load_ground_texture(*source, settings, drawn_by, ground.notes) : std::nullopt;
    if (texture) {
        ground.texture = std::make_shared<const scene::GroundTexture>(std::move(*texture));
    }
}

/// With its texture, and with what is to be said of it. The ground has a source.
SceneGround described(
    std::shared_ptr<const landscape::Ground> ground,
    std::int64_t filled_voids,
    const settings::RunSettings& settings,
    DrawnBy drawn_by) {
    SceneGround loaded;
    loaded.filled_voids = filled_voids;
    loaded.ground = std::move(ground);
    const landscape::GroundSource source = loaded.ground->source().value();
    loaded.name = fmt::format(
        "{}, {} x {} samples, {:.4g} m apart",
        source.area.name,
        source.samples.columns(),
        source.samples.rows(),
        source.samples.spacing_m());
    loaded.place = source.place;
    loaded.frame = models::heights::frame_of_ground(source.area.system, source.place);
    if (filled_voids > 0) {
        loaded.notes.push_back(fmt::format(
            "{}: {} samples without data were filled in", source.area.name, filled_voids));
    }
    add_texture(settings, drawn_by, loaded);
    if (loaded.texture) {
        loaded.name += settings.air.drape ? ", draped" : ", textured";
    }
    return loaded;
}

/// All heights of a ground, in memory.
HeightField field_of(const terrain::GroundTiles& tiles) {
    const terrain::GroundFacts& facts = tiles.facts();
    std::vector<float> heights_m;
    heights_m.reserve(
        static_cast<std::size_t>(tiles.columns()) * static_cast<std::size_t>(tiles.rows()));
    for (int row = 0; row < tiles.rows(); ++row) {
        for (int column = 0; column < tiles.columns(); ++column) {
            heights_m.push_back(tiles.height_m(column, row));
        }
    }
    HeightField field(tiles.columns(), tiles.rows(), tiles.spacing_m(), std::move(heights_m));
    field.name = facts.name;
    field.place = facts.place;
    field.system = facts.system;
    field.filled_voids = facts.filled_voids;
    return field;
}

/// Throws Error for more samples than are levelled in memory.
void check_samples(std::int64_t columns, std::int64_t rows) {
    constexpr std::int64_t most = std::int64_t{16385} * 16385;
    if (columns * rows > most) {
        throw Error(fmt::format(
            "--airfield: expected at most {} samples of ground, got {} x {}", most, columns, rows));
    }
}

/// The ground of these heights, levelled where a runway is to be found.
SceneGround ground_of_field(
    HeightField field,
    const settings::RunSettings& settings,
    DrawnBy drawn_by,
    const RunwayFinder& find_runway) {
    std::vector<std::string> notes;
    for (const models::heights::MapNote& note : field.notes) {
        notes.push_back(note.text);
    }
    std::shared_ptr<const RunwayStrip> runway;
    if (find_runway) {
        check_samples(field.columns(), field.rows());
        runway = std::make_shared<const RunwayStrip>(find_runway(field, notes));
        field = models::heights::levelled(field, *runway);
    }
    const std::int64_t filled_voids = field.filled_voids;
    const settings::RunSettings own = ground_settings(settings, field.place);
    SceneGround loaded = described(
        scene::ground_metric(settings.ground) == scene::GroundMetric::ScreenError
            ? landscape::ground_from_tiles(terrain::ground_of(field), own.air, runway)
            : landscape::ground_from_field(std::move(field), own.ground, own.air, runway),
        filled_voids,
        own,
        drawn_by);
    loaded.notes.insert(loaded.notes.end(), notes.begin(), notes.end());
    return loaded;
}

SceneGround load_imported(
    const settings::RunSettings& settings, DrawnBy drawn_by, const RunwayFinder& find_runway) {
    terrain::GroundTiles ground = visuals::groundfile::open_ground(settings.path.terrain);
    if (find_runway) {
        check_samples(ground.columns(), ground.rows());
        return ground_of_field(field_of(ground), settings, drawn_by, find_runway);
    }
    const std::int64_t filled_voids = ground.facts().filled_voids;
    const settings::RunSettings own = ground_settings(settings, ground.facts().place);
    return described(
        landscape::ground_from_tiles(std::move(ground), own.air), filled_voids, own, drawn_by);
}

SceneGround load_field(
    const settings::RunSettings& settings, DrawnBy drawn_by, const RunwayFinder& find_runway) {
    return ground_of_field(
        load_height_field(settings.path.terrain, import_options(settings.path)),
        settings,
        drawn_by,
        find_runway);
}

SceneGround load_polygons(const settings::RunSettings& settings) {
    SceneGround loaded;
    loaded.name = settings.path.terrain;
    loaded.ground = landscape::ground_from_polygons(
        settings.path.terrain == "none" ? models::polygons::PolygonModel{}
                                        : models::made::background60(),
        ground_settings(settings, std::nullopt).air);
    return loaded;
}

} // namespace

settings::RunSettings
ground_settings(const settings::RunSettings& settings, const std::optional<GeoPlace>& place) {
    settings::RunSettings own = with_sun_of_time(settings, place);
    if (!settings.air.palette && settings.path.terrain == "canyon") {
        own.air.palette = scene::Palette::Arid;
    }
    return own;
}

TerrainInputs terrain_inputs(const settings::PathSettings& settings) {
    TerrainInputs inputs{
        .terrain = settings.terrain, .options = import_options(settings), .files = {}};
    for (const std::filesystem::path& file : ground_files(settings.terrain)) {
        add_stamp(file, inputs.files);
    }
    std::error_code none;
    const std::optional<std::string>& system = inputs.options.system;
    if (system && std::filesystem::is_regular_file(*system, none)) {
        add_stamp(*system, inputs.files);
    }
    return inputs;
}

std::optional<SceneGround> shared_scene_ground(
    const SceneGround& other, const settings::RunSettings& settings, DrawnBy drawn_by) {
    if (terrain_inputs(settings.path) != other.inputs) {
        return std::nullopt;
    }
    const settings::RunSettings own = ground_settings(settings, other.place);
    std::shared_ptr<const landscape::Ground> ground =
        other.ground->suits(own.ground, own.air) ? other.ground
                                                 : other.ground->remade(own.ground, own.air);
    if (!ground || !ground->source()) {
        return std::nullopt;
    }
    SceneGround shared = described(std::move(ground), other.filled_voids, own, drawn_by);
    shared.inputs = other.inputs;
    return shared;
}

std::optional<SceneGround> remade_scene_ground(
    const planning::Scene& scene, const settings::RunSettings& settings, DrawnBy drawn_by) {
    SceneGround remade;
    remade.ground = scene.ground->remade(settings.ground, settings.air);
    if (!remade.ground) {
        return std::nullopt;
    }
    if (scene.ground_texture) {
        add_texture(settings, drawn_by, remade);
    }
    return remade;
}

SceneGround load_scene_ground(
    const settings::RunSettings& settings, DrawnBy drawn_by, const RunwayFinder& find_runway) {
    models::heights::check_system(import_options(settings.path));
    if (settings::is_drawn_whole(settings.path.terrain)) {
        if (find_runway) {
            throw Error(fmt::format(
                "--airfield: expected ground that can be levelled, got '{}'",
                settings.path.terrain));
        }
        return load_polygons(settings);
    }
    // What is written while heights are read makes them old.
    TerrainInputs inputs = terrain_inputs(settings.path);
    SceneGround ground = settings::is_imported_ground(settings.path.terrain)
                             ? load_imported(settings, drawn_by, find_runway)
                             : load_field(settings, drawn_by, find_runway);
    ground.inputs = std::move(inputs);
    return ground;
}

} // namespace octant::ui::world
