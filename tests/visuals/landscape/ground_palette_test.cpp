#include "visuals/landscape/ground_palette.h"

#include <catch2/catch.hpp>

using namespace octant;
using namespace octant::visuals;

namespace {

/// Sums over low, nearly level ground of 30 x 30 km.
nature::Growth growth_in(const nature::Climate& climate) {
    const landscape::GroundPalette palette(scene::AirSettings(), climate);
    nature::Growth sum;
    for (int north = 0; north < 100; ++north) {
        for (int east = 0; east < 100; ++east) {
            const landscape::GroundPoint point{
                300.0F * static_cast<float>(east), 300.0F * static_cast<float>(north), 40.0F};
            const nature::Growth own = palette.growth(point, 30.0F);
            sum.houses += own.houses;
            sum.broadleaves += own.broadleaves;
            sum.conifers += own.conifers;
        }
    }
    return sum;
}

} // namespace

TEST_CASE("low ground far north has few fields with houses and few woods") {
    const nature::Growth middle = growth_in(nature::climate_of(49.0, 8.0));
    const nature::Growth north = growth_in(nature::climate_of(64.0, -22.0));
    CHECK(middle.houses > 10.0F);
    CHECK(north.houses < 0.4F * middle.houses);
    CHECK(north.broadleaves + north.conifers < 0.5F * (middle.broadleaves + middle.conifers));
}

TEST_CASE("made ground has the summers of middle latitudes") {
    const nature::Growth made = growth_in(nature::Climate());
    const nature::Growth middle = growth_in(nature::climate_of(45.0, 8.0));
    CHECK(made.houses == middle.houses);
}
