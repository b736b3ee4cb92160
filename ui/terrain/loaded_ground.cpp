#include "ui/terrain/loaded_ground.h"

#include "ui/base/progress.h"
#include "ui/settings/terrain_name.h"
#include "ui/world/terrain_file.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/terrain/ground_builder.h"

namespace octant::ui::terrain {

namespace terrain = visuals::terrain;

terrain::GroundSamples LoadedGround::samples() const {
    return std::visit([](const auto& ground) { return terrain::GroundSamples(ground); }, ground_);
}

terrain::GroundTiles LoadedGround::tiles() const {
    const models::heights::HeightField* const read = field();
    return read != nullptr ? terrain::ground_of(*read) : std::get<terrain::GroundTiles>(ground_);
}

LoadedGround load_ground(
    const std::string& name_or_file, const models::heights::ImportOptions& options, bool quiet) {
    if (settings::is_imported_ground(name_or_file)) {
        return LoadedGround(visuals::groundfile::open_ground(name_or_file));
    }
    models::heights::HeightField field = world::load_height_field(name_or_file, options);
    for (const models::heights::MapNote& note : field.notes) {
        base::say(quiet, note.text);
    }
    return LoadedGround(std::move(field));
}

} // namespace octant::ui::terrain
