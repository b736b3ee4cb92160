#include "visuals/landscape/shared_roads.h"

#include "visuals/landscape/ground_palette.h"

namespace octant::visuals::landscape {

namespace {

constexpr double highest_desert_town_m = 3000.0; ///< the trees of deserts say nothing of people

} // namespace

std::shared_ptr<const roads::RoadNetwork>
SharedRoads::network(const terrain::GroundTiles& tiles, const models::heights::RunwayStrip* runway) {
    std::call_once(once_, [&] {
        const nature::Climate climate = climate_at(tiles.metadata().place);
        roads::RoadConstraints constraints;
        constraints.water_m = water_level_m_;
        constraints.max_town_height_m =
            climate.arid ? highest_desert_town_m : static_cast<double>(climate.tree_line_m);
        if (runway != nullptr) {
            constraints.is_blocked = [runway](const glm::dvec2& at_m) {
                return runway->distance_m(at_m) < models::heights::side_slope_end_m;
            };
        }
        roads_ = std::make_shared<const roads::RoadNetwork>(terrain::GroundSamples(tiles), constraints);
    });
    return roads_;
}

} // namespace octant::visuals::landscape
