#include "models/procedural/procedural_terrain.h"
#include "visuals/landscape/ground.h"
#include "visuals/terrain/bisection_ground_builder.h"

#include <catch2/catch.hpp>

#include <memory>

using namespace octant;
using namespace octant::visuals;

namespace {

models::heights::RunwayStrip strip_at(const glm::dvec2& begin_m) {
    models::heights::RunwayStrip strip;
    strip.begin_m = begin_m;
    return strip;
}

} // namespace

TEST_CASE("ground in other colours has the same roads, and with other water others") {
    const auto ground = landscape::make_bisection_ground(
        terrain::make_ground_tiles(models::procedural::procedural_hills()), scene::AirSettings());
    const auto roads = ground->road_network();
    REQUIRE(roads);
    REQUIRE_FALSE(roads->sections().empty());
    scene::AirSettings evening;
    evening.sun_elevation_deg = 5.0;
    CHECK(ground->with_settings({}, evening)->road_network() == roads);
    scene::AirSettings flooded;
    flooded.water_level_m = 240.0;
    const auto above_water = ground->with_settings({}, flooded);
    REQUIRE(above_water->road_network() != roads);
    for (const roads::RoadSection& section : above_water->road_network()->sections()) {
        for (const roads::RoadPoint& point : section.levels[0]) {
            REQUIRE(above_water->height_at(point.at_m.x, point.at_m.y).value() > 239.0);
        }
    }
}

TEST_CASE("roads keep off the embankments of a runway") {
    const auto plain = landscape::make_bisection_ground(
        terrain::make_ground_tiles(models::procedural::procedural_hills()), scene::AirSettings());
    // Where a road runs without one.
    const glm::dvec2 on_road_m = plain->road_network()->sections()[20].levels[0].front().at_m;
    const auto strip = std::make_shared<const models::heights::RunwayStrip>(strip_at(on_road_m));
    const auto ground = landscape::make_bisection_ground(
        terrain::make_ground_tiles(models::procedural::procedural_hills()), scene::AirSettings(), strip);
    for (const roads::RoadSection& section : ground->road_network()->sections()) {
        for (const roads::RoadPoint& point : section.levels[0]) { REQUIRE(strip->distance_m(point.at_m) > 200.0); }
    }
}
