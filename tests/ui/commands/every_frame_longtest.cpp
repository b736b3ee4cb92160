#include "tests/ui/commands/key_colour.h"

#include <catch2/catch.hpp>

#include <string>

using namespace octant;

// The checks of which the gl tests take a sample, over every frame: ctest --preset evidence.

TEST_CASE("no crack shows in any frame of any path over the canyon") {
    for (const std::string path : {"straight", "jinking", "pop-up", "turn"}) {
        for (const std::string aircraft : {"f15", "500md"}) {
            INFO(path << " " << aircraft);
            CHECK(tests::cracks_along(path, aircraft, "canyon", 60.0) == 0);
        }
    }
}
