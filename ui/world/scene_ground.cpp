#include "ui/world/scene_ground.h"

#include "models/made/made_up.h"
#include "ui/settings/terrain_name.h"
#include "ui/world/sun_of_time.h"
#include "ui/world/terrain_file.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/terrain/ground_builder.h"

#include <cstdint>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace octant::ui::world {

namespace landscape = visuals::landscape;
namespace scene = visuals::scene;
namespace terrain = visuals::terrain;

namespace {

/// What is to be said of a ground; the ground itself and its texture are still to be filled in.
template <class Field>
SceneGround described(
    const Field& field,
    const std::string& name,
    const std::optional<models::heights::GeoPlace>& place,
    std::int64_t filled_voids) {
    SceneGround loaded;
    loaded.name = fmt::format(
        "{}, {} x {} samples, {:.4g} m apart",
        name,
        field.columns(),
        field.rows(),
        field.spacing_m());
    loaded.place = place;
    if (filled_voids > 0) {
        loaded.notes.push_back(
            fmt::format("{}: {} samples without data were filled in", name, filled_voids));
    }
    return loaded;
}

void add_texture(
    const terrain::GroundSamples& samples,
    const models::heights::GroundArea& area,
    const settings::RunSettings& settings,
    DrawnBy drawn_by,
    SceneGround& loaded) {
    std::optional<scene::GroundTexture> texture =
        load_ground_texture(samples, area, settings, loaded.place, drawn_by, loaded.notes);
    if (texture) {
        loaded.texture = std::make_shared<const scene::GroundTexture>(std::move(*texture));
        loaded.name += settings.air.drape ? ", draped" : ", textured";
    }
}

SceneGround load_imported(const settings::RunSettings& settings, DrawnBy drawn_by) {
    terrain::GroundTiles ground = visuals::groundfile::open_ground(settings.path.terrain);
    const terrain::GroundFacts& facts = ground.facts();
    SceneGround loaded = described(ground, facts.name, facts.place, facts.filled_voids);
    const models::heights::GroundArea area{
        facts.name, ground.half_extent_m(), ground.spacing_m(), facts.system};
    const settings::RunSettings own = ground_settings(settings, facts.place);
    add_texture(terrain::GroundSamples(ground), area, own, drawn_by, loaded);
    loaded.ground = landscape::ground_from_tiles(std::move(ground), own.air);
    return loaded;
}

SceneGround load_field(const settings::RunSettings& settings, DrawnBy drawn_by) {
    models::heights::HeightField field =
        load_height_field(settings.path.terrain, import_options(settings.path));
    SceneGround loaded = described(field, field.name, field.place, field.filled_voids);
    const settings::RunSettings own = ground_settings(settings, field.place);
    add_texture(
        terrain::GroundSamples(field), models::heights::area_of(field), own, drawn_by, loaded);
    loaded.ground = scene::ground_metric(settings.ground) == scene::GroundMetric::ScreenError
                        ? landscape::ground_from_tiles(terrain::ground_of(field), own.air)
                        : landscape::ground_from_field(std::move(field), own.ground, own.air);
    return loaded;
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

settings::RunSettings ground_settings(
    const settings::RunSettings& settings, const std::optional<models::heights::GeoPlace>& place) {
    settings::RunSettings own = with_sun_of_time(settings, place);
    if (!settings.air.palette && settings.path.terrain == "canyon") {
        own.air.palette = scene::Palette::Arid;
    }
    return own;
}

SceneGround load_scene_ground(const settings::RunSettings& settings, DrawnBy drawn_by) {
    if (settings::is_drawn_whole(settings.path.terrain)) {
        return load_polygons(settings);
    }
    return settings::is_imported_ground(settings.path.terrain) ? load_imported(settings, drawn_by)
                                                               : load_field(settings, drawn_by);
}

} // namespace octant::ui::world
