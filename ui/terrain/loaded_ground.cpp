#include "ui/terrain/loaded_ground.h"

#include "ui/base/progress.h"
#include "ui/settings/terrain_name.h"
#include "ui/world/scene_ground.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/terrain/ground_builder.h"
#include "visuals/terrain/ground_query.h"

namespace octant::ui::terrain {

namespace terrain = visuals::terrain;

terrain::GroundSamples LoadedGround::samples() const {
    return std::visit([](const auto& ground) { return terrain::GroundSamples(ground); }, ground_);
}

double LoadedGround::mean_radius_m() const {
    const models::heights::HeightField* const read = field();
    return ellipsoid_below(read != nullptr ? read->place : std::get<terrain::GroundTiles>(ground_).metadata().place)
        .mean_radius_m();
}

terrain::GroundTiles LoadedGround::tiles() const {
    const models::heights::HeightField* const read = field();
    return read != nullptr ? terrain::make_ground_tiles(*read) : std::get<terrain::GroundTiles>(ground_);
}

LoadedGround load_ground(const std::string& name_or_file, const models::heights::ImportOptions& options, bool quiet) {
    if (settings::is_imported_ground(name_or_file)) {
        return LoadedGround(visuals::groundfile::open_ground(name_or_file));
    }
    models::heights::HeightField field = world::load_height_field(name_or_file, options);
    for (const models::heights::MapNote& note : field.notes) { base::print_note(quiet, note.text); }
    return LoadedGround(std::move(field));
}

LoadedGround load_ground(GroundViewOptions& options, bool quiet) {
    LoadedGround ground = load_ground(options.terrain, options.files, quiet);
    options.earth_radius_m = options.curved ? ground.mean_radius_m() : 0.0;
    if (options.eye_m) {
        const auto low = world::low_eye_note(
            *options.eye_m, terrain::ground_height_m(ground.samples(), options.eye_m->x, options.eye_m->y));
        base::print_note(quiet || !low, low.value_or(""));
    }
    return ground;
}

} // namespace octant::ui::terrain
