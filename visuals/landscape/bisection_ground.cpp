#include "visuals/landscape/bisection_ground.h"

#include "visuals/landscape/ground_colours.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/landscape/vertex_colours.h"

#include <utility>

namespace octant::visuals::landscape {

BisectionGround::BisectionGround(
    std::shared_ptr<const terrain::GroundTiles> tiles,
    const scene::AirSettings& air,
    std::shared_ptr<const models::heights::RunwayStrip> runway,
    std::shared_ptr<SharedRoads> roads)
    : Ground(std::move(runway))
    , tiles_(std::move(tiles))
    , air_(air)
    , roads_(
          roads && roads->water_level_m() == air.water_level_m
              ? std::move(roads)
              : std::make_shared<SharedRoads>(air.water_level_m))
    , terrain_shadows_(make_relief_shadows(terrain::GroundSamples(*tiles_), air))
    , contrast_(std::make_shared<const scene::LandCoverContrast>(
          GroundPalette(air, climate_at(tiles_->metadata().place)).contrast()))
    , mean_colour_(VertexColours(*tiles_, air, terrain_shadows_).mean()) {}

bool BisectionGround::allows_scenery(int column, int row) const {
    constexpr double clear_m = models::heights::level_margin_m;
    const glm::dvec2 at_m = (glm::dvec2(column, row) + 0.5) * spacing_m() - tiles_->half_extent_m();
    return !runway() || runway()->distance_m(at_m) > clear_m + spacing_m();
}

glm::vec3 BisectionGround::colour_at(double x_m, double y_m, double footprint_m) const {
    const terrain::GroundSamples samples(*tiles_);
    const GroundPalette palette(air_, climate_at(tiles_->metadata().place), terrain_shadows_);
    return nearest_colour(samples, palette, {x_m, y_m}, footprint_m);
}

float BisectionGround::cover_code_at(double x_m, double y_m, double footprint_m) const {
    const GroundPalette palette(air_, climate_at(tiles_->metadata().place));
    return palette.cover_code(
        nearest_point(terrain::GroundSamples(*tiles_), {x_m, y_m}, footprint_m),
        static_cast<float>(footprint_m));
}

nature::LightVisibility BisectionGround::light_visibility(double x_m, double y_m) const {
    const glm::vec2 at_m(glm::dvec2(x_m, y_m) + half_extent_m());
    return terrain_shadows_ ? terrain_shadows_->at(at_m.x, at_m.y, static_cast<float>(spacing_m()))
                   : nature::LightVisibility();
}

std::shared_ptr<const roads::RoadNetwork> BisectionGround::road_network() const {
    const bool has_people = ellipsoid_below(tiles_->metadata().place).is_earth();
    return has_people ? roads_->network(*tiles_, runway().get()) : nullptr;
}

std::optional<GroundTextureSource> BisectionGround::source() const {
    const terrain::GroundMetadata& metadata = tiles_->metadata();
    return GroundTextureSource{
        terrain::GroundSamples(*tiles_),
        {metadata.name, tiles_->half_extent_m(), tiles_->spacing_m(), metadata.system},
        metadata.place};
}

bool BisectionGround::has_mesh_settings(const scene::GroundSettings& settings) const {
    return ground_metric(settings) == scene::GroundMetric::ScreenError;
}

bool BisectionGround::has_colour_settings(const scene::AirSettings& settings) const {
    return same_colours(settings, air_);
}

std::shared_ptr<const Ground>
BisectionGround::with_settings(const scene::GroundSettings& ground, const scene::AirSettings& air) const {
    return has_mesh_settings(ground) ? std::make_shared<BisectionGround>(tiles_, air, runway(), roads_)
                                : nullptr;
}

std::unique_ptr<GroundMesher> BisectionGround::make_mesher(const MeshSettings& settings) const {
    return bisection_mesher(std::static_pointer_cast<const BisectionGround>(shared_from_this()), settings);
}

std::shared_ptr<const Ground> make_bisection_ground(
    terrain::GroundTiles ground,
    const scene::AirSettings& air,
    std::shared_ptr<const models::heights::RunwayStrip> runway) {
    return std::make_shared<BisectionGround>(
        std::make_shared<const terrain::GroundTiles>(std::move(ground)), air, std::move(runway));
}

} // namespace octant::visuals::landscape
