#pragma once

#include "models/heights/runway_strip.h"
#include "visuals/roads/road_network.h"
#include "visuals/terrain/ground_tiles.h"

#include <memory>
#include <mutex>

namespace octant::visuals::landscape {

/// The roads of a ground, found when they are first asked for, which is loading work, and shared by
/// all grounds of the same heights and water.
class SharedRoads {
public:
    explicit SharedRoads(double water_level_m)
        : water_level_m_(water_level_m) {}

    double water_level_m() const { return water_level_m_; }

    /// On this ground, the same in each call. `runway`: which roads keep off; null where there is
    /// none.
    std::shared_ptr<const roads::RoadNetwork>
    network(const terrain::GroundTiles& tiles, const models::heights::RunwayStrip* runway);

private:
    double water_level_m_;
    std::once_flag once_;
    std::shared_ptr<const roads::RoadNetwork> roads_;
};

} // namespace octant::visuals::landscape
