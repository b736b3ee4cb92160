#include "ui/world/scene_ground.h"

#include "models/made/made_up.h"
#include "ui/settings/terrain_name.h"
#include "ui/world/terrain_file.h"
#include "visuals/terrain/ground_builder.h"
#include "visuals/terrain/ground_file.h"

#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace octant::ui::world {

namespace scene = visuals::scene;
namespace terrain = visuals::terrain;

namespace {

template <class Field>
void describe_ground(
    const Field& field,
    const std::string& name,
    const std::optional<models::heights::GeoPlace>& place,
    std::int64_t filled_voids,
    World& world) {
    world.ground_name = fmt::format(
        "{}, {} x {} samples, {:.4g} m apart",
        name,
        field.columns(),
        field.rows(),
        field.spacing_m());
    world.ground_place = place;
    if (filled_voids > 0) {
        world.notes.push_back(
            fmt::format("{}: {} samples without data were filled in", name, filled_voids));
    }
}

} // namespace

void texture_ground(
    const terrain::GroundSamples& ground,
    const models::heights::GroundArea& area,
    const settings::Settings& settings,
    DrawnBy drawn_by,
    World& world) {
    world.scene.ground_texture = load_ground_texture(ground, area, settings, drawn_by, world.notes);
    if (world.scene.ground_texture) {
        world.ground_name += settings.air.drape ? ", draped" : ", textured";
    }
}

void load_imported(const settings::Settings& settings, DrawnBy drawn_by, World& world) {
    terrain::GroundTiles ground = terrain::open_ground(settings.path.terrain);
    const terrain::GroundFacts& facts = ground.facts();
    describe_ground(ground, facts.name, facts.place, facts.filled_voids, world);
    const models::heights::GroundArea area{
        facts.name, ground.half_extent_m(), ground.spacing_m(), facts.system};
    texture_ground(terrain::GroundSamples(ground), area, settings, drawn_by, world);
    world.scene.ground = scene::ground_from_tiles(std::move(ground), settings);
}

settings::Settings ground_settings(const settings::Settings& settings) {
    settings::Settings own = settings;
    if (!settings.air.palette && settings.path.terrain == "canyon") {
        own.air.palette = scene::Palette::Arid;
    }
    return own;
}

void load_scene_ground(const settings::Settings& settings, DrawnBy drawn_by, World& world) {
    world.ground_name = settings.path.terrain;
    if (settings::is_drawn_whole(settings.path.terrain)) {
        check_untextured_ground(settings);
        world.scene.ground = scene::ground_from_polygons(
            settings.path.terrain == "none" ? models::polygons::PolygonModel{}
                                            : models::made::background60(),
            settings);
        return;
    }
    const settings::Settings colours = ground_settings(settings);
    if (settings::is_imported_ground(settings.path.terrain)) {
        load_imported(settings, drawn_by, world);
        return;
    }
    models::heights::HeightField field =
        load_height_field(settings.path.terrain, settings.path.terrain_spacing_m);
    describe_ground(field, field.name, field.place, field.filled_voids, world);
    texture_ground(
        terrain::GroundSamples(field), models::heights::area_of(field), colours, drawn_by, world);
    world.scene.ground = scene::ground_metric(settings.ground) == scene::GroundMetric::ScreenError
                             ? scene::ground_from_tiles(terrain::ground_of(field), colours)
                             : scene::ground_from_field(std::move(field), colours);
}

} // namespace octant::ui::world
