#include "visuals/nature/climate.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

using octant::visuals::nature::climate_of;

TEST_CASE("trees and snow are where travellers find them") {
    // Tree line in the Alps 1,900 to 2,300 m, in Scandinavia at 68 degrees 400 to 800 m, in the Himalaya about 3,900 m;
    // snow there from 5,000 to 6,000 m, in the Alps from 2,700 to 3,200 m.
    CHECK(std::abs(climate_of(46.5, 8.0).tree_line_m - 2200.0F) < 250.0F);
    CHECK(std::abs(climate_of(68.0, 18.0).tree_line_m - 500.0F) < 300.0F);
    CHECK(climate_of(28.0, 87.0).tree_line_m > 3500.0F);
    CHECK(climate_of(28.0, 87.0).snow_line_m > 5000.0F);
    CHECK(std::abs(climate_of(46.5, 8.0).snow_line_m - 2900.0F) < 300.0F);
    CHECK(climate_of(85.0, 0.0).snow_line_m < 200.0F);
    for (double latitude = -90.0; latitude <= 90.0; latitude += 1.5) {
        CHECK(climate_of(latitude, 0.0).tree_line_m <= climate_of(latitude, 0.0).snow_line_m);
    }
}

TEST_CASE("deserts are arid, also across the date line's count, and the rest is not") {
    CHECK(climate_of(35.0, -116.0).is_arid()); // Mojave
    CHECK(climate_of(23.0, 5.0).is_arid());    // Hoggar
    CHECK(climate_of(-25.3, 131.0 - 360.0).is_arid());
    CHECK_FALSE(climate_of(46.5, 8.0).is_arid());
    CHECK_FALSE(climate_of(28.0, 87.0).is_arid());
    CHECK_FALSE(climate_of(45.0, -70.0).is_arid());
}

TEST_CASE("plains and coasts of half-dry climates are neither deserts nor moist") {
    // Great Plains, San Gabriel Mountains, Grand Canyon, whose rims are steppe, La Mancha, Kazakhstan.
    for (const auto& [latitude, longitude] :
        {std::pair(40.2, -104.0), {34.3, -118.0}, {36.1, -112.1}, {39.0, -3.0}, {48.0, 68.0}}) {
        CAPTURE(latitude, longitude);
        CHECK(climate_of(latitude, longitude).dryness > 0.3F);
        CHECK_FALSE(climate_of(latitude, longitude).is_arid());
    }
    for (const auto& [latitude, longitude] : {std::pair(51.0, 0.5), {49.5, -123.0}, {35.4, 138.7}, {-3.0, -60.0}}) {
        CAPTURE(latitude, longitude);
        CHECK(climate_of(latitude, longitude).dryness == 0.0F);
    }
}

TEST_CASE("the climate changes gradually, and lakes, seas and poles have one") {
    float before = climate_of(30.0, -114.0).dryness;
    float most = 0.0F;
    for (double longitude = -114.0; longitude < -82.0; longitude += 0.05) { // from coast to coast
        const float dryness = climate_of(30.0, longitude).dryness;
        CHECK(std::abs(dryness - before) < 0.11F);
        before = dryness;
        most = std::max(most, dryness);
    }
    CHECK(most == 1.0F);
    for (const double latitude : {-90.0, 0.0, 90.0}) { CHECK(climate_of(latitude, -180.0).dryness == 0.0F); }
    CHECK(climate_of(24.0, 179.99).dryness == climate_of(24.0, -180.01).dryness);
}
