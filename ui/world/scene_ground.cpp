#include "ui/world/scene_ground.h"

#include "models/heights/height_source.h"
#include "models/heights/image.h"
#include "models/heights/local_frame.h"
#include "models/heights/map_inputs.h"
#include "models/heights/runway_strip.h"
#include "models/procedural/procedural_models.h"
#include "sim/base/error.h"
#include "sim/sun_position.h"
#include "ui/settings/settings_check.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/landscape/ground_texture_maker.h"
#include "visuals/terrain/bisection_ground_builder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::world {

namespace {

std::optional<sim::SunPosition> sun_of(
    const visuals::scene::AirSettings& air, const std::optional<GeoPosition>& place) {
    const auto time = air.time ? sim::solar_time_from_text(*air.time) : std::nullopt;
    return time ? std::optional(sim::sun_position(latitude_of(place), *time)) : std::nullopt;
}

} // namespace

double latitude_of(const std::optional<GeoPosition>& place) {
    constexpr double default_deg = 45.0;
    return place ? place->latitude_deg : default_deg;
}

settings::RunSettings with_sun_at_time(settings::RunSettings settings, const std::optional<GeoPosition>& place) {
    if (const auto sun = sun_of(settings.air, place)) {
        settings.air.sun_azimuth_deg = sun->azimuth_deg;
        settings.air.sun_elevation_deg = std::clamp(sun->elevation_deg, 0.0, 90.0);
    }
    return settings;
}

settings::RunSettings with_sun_updated(
    settings::RunSettings settings, const settings::RunSettings& before, const std::optional<GeoPosition>& place) {
    const bool moved_by_hand =
        settings.air.time == before.air.time && (settings.air.sun_azimuth_deg != before.air.sun_azimuth_deg ||
                                                    settings.air.sun_elevation_deg != before.air.sun_elevation_deg);
    if (moved_by_hand) { settings.air.time.reset(); }
    return with_sun_at_time(std::move(settings), place);
}

std::vector<std::string> sun_notes(const settings::RunSettings& settings, const std::optional<GeoPosition>& place) {
    std::vector<std::string> notes;
    const auto sun = sun_of(settings.air, place);
    if (const Ellipsoid below = ellipsoid_below(place); sun && !below.is_earth()) {
        notes.push_back(
            fmt::format("--time {}: the sun stands as over the earth at this latitude and date, not as over {}",
                *settings.air.time, name_of_body(below)));
    }
    if (sun && sun->elevation_deg < 0.0) {
        notes.push_back(fmt::format("--time {}: the sun is {:.0f} degrees below the horizon at latitude {:.1f}; it is "
                                    "shown on the horizon",
            *settings.air.time, -sun->elevation_deg, latitude_of(place)));
    }
    return notes;
}

namespace landscape = visuals::landscape;
namespace planning = visuals::planning;
namespace scene = visuals::scene;
namespace terrain = visuals::terrain;
using models::heights::HeightField;
using models::heights::RunwayStrip;
using scene::GroundShading;

std::optional<std::string> low_eye_note(const glm::dvec3& eye_m, const std::optional<double>& ground_m) {
    if (!ground_m || eye_m.z >= *ground_m) { return std::nullopt; }
    constexpr double clear_m = 2.0;
    return fmt::format("--eye {0:g},{1:g},{2:g} lies {3:.1f} m under the ground, which is {4:.1f} m high there: "
                       "--eye "
                       "{0:g},{1:g},{5:.0f} lies above it",
        eye_m.x, eye_m.y, eye_m.z, *ground_m - eye_m.z, *ground_m, std::ceil(*ground_m + clear_m));
}

std::optional<scene::GroundTexture> load_ground_texture(const landscape::GroundTextureSource& ground,
    const settings::RunSettings& settings, RenderDevice device, std::vector<std::string>& notes) {
    const visuals::nature::Climate climate = landscape::climate_at(ground.place);
    if (settings.air.drape) {
        const models::heights::Image drape = models::heights::resampled_to_ground(
            models::heights::read_image(*settings.air.drape), ground.area, landscape::max_texture_size_px);
        if (!drape.note.empty()) { notes.push_back(drape.note); }
        return landscape::ground_texture(ground.samples, settings.air, &drape, climate);
    }
    const bool textured = settings.air.ground_shading == GroundShading::Texture ||
                          (settings.air.ground_shading == GroundShading::Auto && device == RenderDevice::Gpu);
    return textured ? std::optional(landscape::ground_texture(ground.samples, settings.air, nullptr, climate))
                    : std::nullopt;
}

namespace {

void add_texture(const settings::RunSettings& settings, RenderDevice device, SceneGround& ground) {
    const std::optional<landscape::GroundTextureSource> source = ground.ground->source();
    std::optional<scene::GroundTexture> texture =
        source ? load_ground_texture(*source, settings, device, ground.notes) : std::nullopt;
    if (texture) { ground.texture = std::make_shared<const scene::GroundTexture>(std::move(*texture)); }
}

/// Completes a ground that has samples: name, place, notes and texture.
SceneGround with_texture_and_notes(std::shared_ptr<const landscape::Ground> ground, std::int64_t filled_voids,
    const settings::RunSettings& settings, RenderDevice device) {
    SceneGround loaded;
    loaded.info.filled_voids = filled_voids;
    loaded.ground = std::move(ground);
    const landscape::GroundTextureSource source = loaded.ground->source().value();
    loaded.info.name = fmt::format("{}, {} x {} samples, {:.4g} m apart", source.area.name, source.samples.columns(),
        source.samples.rows(), source.samples.spacing_m());
    loaded.info.place = source.place;
    loaded.info.frame = models::heights::frame_of_ground(source.area.system, source.place);
    if (filled_voids > 0) {
        loaded.notes.push_back(
            fmt::format("{}: {} samples without data were filled in", source.area.name, filled_voids));
    }
    if (!source.place && !settings.air.palette && !settings.air.drape &&
        !terrain_sources(settings.path).files.empty()) {
        loaded.notes.push_back(
            fmt::format("{}: its place on the earth is not known, so it is shown as moist, temperate land; "
                        "--ground-look palette=arid shows a desert",
                source.area.name));
    }
    add_texture(settings, device, loaded);
    if (loaded.texture) { loaded.info.name += settings.air.drape ? ", draped" : ", textured"; }
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
        throw Error(
            fmt::format("--show airfield: expected at most {} samples of ground, got {} x {}", most, columns, rows));
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
        landscape::make_field_ground(std::move(field), own.ground, own.air, runway), filled_voids, own, device);
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

SceneGround load_polygons(const settings::RunSettings& settings) {
    SceneGround loaded;
    loaded.info.name = settings.path.terrain;
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

std::optional<SceneGround> shared_scene_ground(const GroundInfo& info,
    const std::shared_ptr<const landscape::Ground>& ground, const settings::RunSettings& settings,
    RenderDevice device) {
    if (terrain_sources(settings.path) != info.inputs) { return std::nullopt; }
    const settings::RunSettings own = with_ground_defaults(settings, info.place);
    std::shared_ptr<const landscape::Ground> shown =
        ground->matches_settings(own.ground, own.air) ? ground : ground->with_settings(own.ground, own.air);
    if (!shown || !shown->source()) { return std::nullopt; }
    SceneGround shared = with_texture_and_notes(std::move(shown), info.filled_voids, own, device);
    shared.info.inputs = info.inputs;
    return shared;
}

std::optional<SceneGround> rebuilt_scene_ground(
    const planning::Scene& scene, const settings::RunSettings& settings, RenderDevice device) {
    SceneGround rebuilt;
    rebuilt.ground = scene.ground->with_settings(settings.ground, settings.air);
    if (!rebuilt.ground) { return std::nullopt; }
    if (scene.ground_texture) { add_texture(settings, device, rebuilt); }
    return rebuilt;
}

SceneGround load_scene_ground(
    const settings::RunSettings& settings, RenderDevice device, const RunwayFinder& find_runway) {
    models::heights::check_coordinate_system(import_options(settings.path));
    if (settings::has_no_detail_levels(settings.path.terrain)) {
        if (find_runway) {
            throw Error(
                fmt::format("--show airfield: expected ground that can be levelled, got '{}'", settings.path.terrain));
        }
        return load_polygons(settings);
    }
    // Taken before reading: a file that changes meanwhile counts as changed.
    TerrainSources inputs = terrain_sources(settings.path);
    SceneGround ground = settings::is_imported_ground(settings.path.terrain)
                             ? load_imported(settings, device, find_runway)
                             : ground_of_field(load_height_field(settings.path.terrain, import_options(settings.path)),
                                   settings, device, find_runway);
    ground.info.inputs = std::move(inputs);
    return ground;
}

} // namespace octant::ui::world
