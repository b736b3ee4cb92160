#include "visuals/landscape/ground_palette.h"

#include <catch2/catch.hpp>

using namespace octant;
using namespace octant::visuals;

namespace {

/// Sums over low, nearly level ground of 30 x 30 km.
nature::SceneryDensity growth_in(const nature::Climate& climate) {
    const landscape::GroundPalette palette(scene::AirSettings(), climate);
    nature::SceneryDensity sum;
    for (int north = 0; north < 100; ++north) {
        for (int east = 0; east < 100; ++east) {
            const landscape::TerrainPoint point{
                300.0F * static_cast<float>(east), 300.0F * static_cast<float>(north), 40.0F};
            const nature::SceneryDensity own = palette.scenery_density(point, 30.0F);
            sum.houses += own.houses;
            sum.broadleaves += own.broadleaves;
            sum.conifers += own.conifers;
        }
    }
    return sum;
}

} // namespace

TEST_CASE("low ground far north has few fields with houses and few woods") {
    const nature::SceneryDensity middle = growth_in(nature::climate_of(49.0, 8.0));
    const nature::SceneryDensity north = growth_in(nature::climate_of(64.0, -22.0));
    CHECK(middle.houses > 10.0F);
    CHECK(north.houses < 0.4F * middle.houses);
    CHECK(north.broadleaves + north.conifers < 0.5F * (middle.broadleaves + middle.conifers));
}

TEST_CASE("made ground has the summers of middle latitudes") {
    const nature::SceneryDensity made = growth_in(nature::Climate());
    const nature::SceneryDensity middle = growth_in(nature::climate_of(45.0, 8.0));
    CHECK(made.houses == middle.houses);
}

TEST_CASE("on Mars and the Moon there is no water, nothing grows, and the Moon is grey") {
    const nature::Climate mars = landscape::climate_at(GeoPosition{45.0, 8.0, {3396190.0, 0.0}});
    const nature::Climate moon = landscape::climate_at(GeoPosition{45.0, 8.0, {1737400.0, 0.0}});
    CHECK(growth_in(mars).houses + growth_in(mars).broadleaves + growth_in(mars).shrubs == 0.0F);
    scene::AirSettings temperate;
    temperate.palette = scene::Palette::Temperate;
    landscape::TerrainPoint level{300.0F, 300.0F, -4000.0F};
    level.normal = {0.0F, 0.0F, 1.0F};
    CHECK(landscape::GroundPalette({}, nature::Climate()).is_water(level));
    for (const nature::Climate& climate : {mars, moon}) {
        const landscape::GroundPalette palette(temperate, climate);
        CHECK_FALSE(palette.is_water(level));
        CHECK(palette.cover_code(level, 30.0F) >= 64.0F);
        level.height_m = 21000.0F;
        const glm::vec3 colour = palette.albedo(level, 30.0F);
        CHECK(colour.x >= colour.y); // neither green nor snow
        CHECK(colour.x < 0.8F);
        level.height_m = -4000.0F;
    }
    const glm::vec3 grey = landscape::GroundPalette({}, moon).albedo(level, 30.0F);
    CHECK(grey.x < 1.1F * grey.z);
    const glm::vec3 rust = landscape::GroundPalette({}, mars).albedo(level, 30.0F);
    CHECK(rust.x > 1.6F * rust.z);
}
