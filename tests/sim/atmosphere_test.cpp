#include "sim/atmosphere.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace octant::sim;

TEST_CASE("standard air is that of the published tables") {
    CHECK(standard_air(0.0).density_kgpm3 == Approx(1.225));
    CHECK(standard_air(0.0).speed_of_sound_mps == Approx(340.294));
    CHECK(standard_air(5000.0).density_kgpm3 == Approx(0.73643).epsilon(2e-3));
    CHECK(standard_air(11000.0).density_kgpm3 == Approx(0.36391).epsilon(1e-4));
    CHECK(standard_air(11000.0).speed_of_sound_mps == Approx(295.07).epsilon(1e-4));
    CHECK(standard_air(20000.0).density_kgpm3 == Approx(0.08803).epsilon(1e-3));
    CHECK(standard_air(32000.0).density_kgpm3 == Approx(0.01322).epsilon(2e-3));
}

TEST_CASE("standard air thins steadily, and has an answer at any height") {
    double before = 10.0;
    for (double height_m = -2000.0; height_m <= 80000.0; height_m += 250.0) {
        const Air air = standard_air(height_m);
        CHECK(air.density_kgpm3 < before);
        CHECK(air.density_kgpm3 > 0.0);
        before = air.density_kgpm3;
    }
    CHECK(standard_air(1e9).density_kgpm3 == standard_air(80000.0).density_kgpm3);
    CHECK(standard_air(-1e9).density_kgpm3 == standard_air(-2000.0).density_kgpm3);
}
