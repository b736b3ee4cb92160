#include "tests/ui/commands/key_colour.h"

#include <catch2/catch.hpp>

#include <string>

using namespace octant;

TEST_CASE("no crack shows on any path over the canyon, a frame a second") {
    for (const std::string path : {"straight", "jinking", "pop-up", "turn"}) {
        for (const std::string aircraft : {"f15", "500md"}) {
            INFO(path << " " << aircraft);
            CHECK(tests::cracks_along(path, aircraft, "canyon", 1.0) == 0);
        }
    }
}

TEST_CASE("the printed propagation does crack, so the test can see one") {
    ui::settings::RunSettings settings = tests::key_colour_settings("straight", "f15", "canyon", 1.0);
    settings.ground.lod.propagation = visuals::terrain::RoughnessPropagation::Printed;
    settings.ground.triangles = 4000;
    CHECK(tests::cracks_in_flight(settings) > 0);
}
