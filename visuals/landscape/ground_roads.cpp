#include "visuals/landscape/ground_roads.h"

#include "visuals/landscape/ground_palette.h"

namespace octant::visuals::landscape {

namespace {

constexpr double highest_desert_town_m = 3000.0; ///< the trees of deserts say nothing of people

} // namespace

std::shared_ptr<const roads::RoadNetwork>
GroundRoads::on(const terrain::GroundTiles& tiles, const models::heights::RunwayStrip* runway) {
    std::call_once(once_, [&] {
        const nature::Climate climate = climate_at(tiles.facts().place);
        roads::RoadWish wish;
        wish.water_m = water_level_m_;
        wish.highest_town_m =
            climate.arid ? highest_desert_town_m : static_cast<double>(climate.tree_line_m);
        if (runway != nullptr) {
            wish.is_taken = [runway](const glm::dvec2& at_m) {
                return runway->distance_m(at_m) < models::heights::sides_end_m;
            };
        }
        roads_ = std::make_shared<const roads::RoadNetwork>(terrain::GroundSamples(tiles), wish);
    });
    return roads_;
}

} // namespace octant::visuals::landscape
