#pragma once

#include "models/heights/height_field.h"
#include "models/heights/import_options.h"
#include "ui/terrain/ground_view.h"
#include "visuals/terrain/ground_query.h"
#include "visuals/terrain/ground_tiles.h"

#include <string>
#include <utility>
#include <variant>

namespace octant::ui::terrain {

/// A terrain as it was given: read whole, or imported and mapped.
class LoadedGround {
public:
    explicit LoadedGround(models::heights::HeightField field) : ground_(std::move(field)) {}

    explicit LoadedGround(visuals::terrain::GroundTiles tiles) : ground_(std::move(tiles)) {}

    /// A view of the samples, valid as long as this ground stays where it is.
    visuals::terrain::GroundSamples samples() const;

    /// Nothing for an imported ground.
    const models::heights::HeightField* field() const { return std::get_if<models::heights::HeightField>(&ground_); }

    /// By which it curves: that of the planet on which it lies, of the earth for made ground.
    double mean_radius_m() const;

    /// What screen-error meshes are made of: built here from a field that was read.
    visuals::terrain::GroundTiles tiles() const;

private:
    std::variant<models::heights::HeightField, visuals::terrain::GroundTiles> ground_;
};

/// By name (hills, canyon), imported, or maps as world::load_height_field takes them; says the maps' notes on stderr
/// unless `quiet`. Throws Error.
LoadedGround load_ground(
    const std::string& name_or_file, const models::heights::ImportOptions& options, bool quiet = false);

/// The terrain of these options, whose `earth_radius_m` is set where the ground is to be curved. Says on stderr, unless
/// `quiet`, where the eye point lies under the ground.
LoadedGround load_ground(GroundViewOptions& options, bool quiet = false);

} // namespace octant::ui::terrain
