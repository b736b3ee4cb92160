#include "visuals/landscape/tile_ground.h"

#include "visuals/landscape/ground_colours.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/landscape/vertex_colours.h"

#include <utility>

namespace octant::visuals::landscape {

TileGround::TileGround(
    std::shared_ptr<const terrain::GroundTiles> tiles,
    const scene::AirSettings& air,
    std::shared_ptr<const models::heights::RunwayStrip> runway,
    std::shared_ptr<GroundRoads> roads)
    : Ground(std::move(runway))
    , tiles_(std::move(tiles))
    , air_(air)
    , roads_(
          roads && roads->water_level_m() == air.water_level_m
              ? std::move(roads)
              : std::make_shared<GroundRoads>(air.water_level_m))
    , relief_(relief_light(terrain::GroundSamples(*tiles_), air))
    , contrast_(std::make_shared<const scene::CoverContrast>(
          GroundPalette(air, climate_at(tiles_->facts().place)).contrast()))
    , mean_colour_(VertexColours(*tiles_, air, relief_).mean()) {}

bool TileGround::may_bear(int column, int row) const {
    constexpr double clear_m = models::heights::levelled_beside_m;
    const glm::dvec2 at_m = (glm::dvec2(column, row) + 0.5) * spacing_m() - tiles_->half_extent_m();
    return !runway() || runway()->distance_m(at_m) > clear_m + spacing_m();
}

glm::vec3 TileGround::colour_at(double x_m, double y_m, double footprint_m) const {
    const terrain::GroundSamples samples(*tiles_);
    const GroundPalette palette(air_, climate_at(tiles_->facts().place), relief_);
    return nearest_colour(samples, palette, {x_m, y_m}, footprint_m);
}

float TileGround::covers_at(double x_m, double y_m, double footprint_m) const {
    const GroundPalette palette(air_, climate_at(tiles_->facts().place));
    return palette.covers(
        nearest_point(terrain::GroundSamples(*tiles_), {x_m, y_m}, footprint_m),
        static_cast<float>(footprint_m));
}

nature::LightLeft TileGround::light_left(double x_m, double y_m) const {
    const glm::vec2 at_m(glm::dvec2(x_m, y_m) + half_extent_m());
    return relief_ ? relief_->at(at_m.x, at_m.y, static_cast<float>(spacing_m()))
                   : nature::LightLeft();
}

std::shared_ptr<const roads::RoadNetwork> TileGround::road_network() const {
    const bool has_people = ellipsoid_below(tiles_->facts().place).is_earth();
    return has_people ? roads_->on(*tiles_, runway().get()) : nullptr;
}

std::optional<GroundSource> TileGround::source() const {
    const terrain::GroundFacts& facts = tiles_->facts();
    return GroundSource{
        terrain::GroundSamples(*tiles_),
        {facts.name, tiles_->half_extent_m(), tiles_->spacing_m(), facts.system},
        facts.place};
}

bool TileGround::is_meshed_as(const scene::GroundSettings& settings) const {
    return ground_metric(settings) == scene::GroundMetric::ScreenError;
}

bool TileGround::is_coloured_as(const scene::AirSettings& settings) const {
    return same_colours(settings, air_);
}

std::shared_ptr<const Ground>
TileGround::remade(const scene::GroundSettings& ground, const scene::AirSettings& air) const {
    return is_meshed_as(ground) ? std::make_shared<TileGround>(tiles_, air, runway(), roads_)
                                : nullptr;
}

std::unique_ptr<GroundMesher> TileGround::make_mesher(const MeshSettings& settings) const {
    return tile_mesher(std::static_pointer_cast<const TileGround>(shared_from_this()), settings);
}

std::shared_ptr<const Ground> ground_from_tiles(
    terrain::GroundTiles ground,
    const scene::AirSettings& air,
    std::shared_ptr<const models::heights::RunwayStrip> runway) {
    return std::make_shared<TileGround>(
        std::make_shared<const terrain::GroundTiles>(std::move(ground)), air, std::move(runway));
}

} // namespace octant::visuals::landscape
