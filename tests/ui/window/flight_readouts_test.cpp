#include "sim/aircraft_kind.h"
#include "sim/flight_models.h"
#include "ui/window/flight_readouts.h"

#include <catch2/catch.hpp>

using namespace octant;
using ui::window::flight_readouts;

TEST_CASE("a pilot is told throttle, speed, height, climb, angle of attack and load factor") {
    const sim::AircraftKind& f15 = sim::aircraft_kind("f15");
    const sim::AircraftState level = sim::trimmed_state(f15, {0, 0, 1000}, 0.0, 200.0);
    const auto numbers = flight_readouts(f15, level, {.throttle = 0.256});
    REQUIRE(numbers.size() == 6);
    CHECK(numbers[0].name == "throttle");
    CHECK(numbers[0].value == "26 %");
    CHECK(numbers[1].value == "389 kt");
    CHECK(numbers[2].value == "3281 ft");
    CHECK(numbers[3].value == "+0 ft/min");
    CHECK(numbers[4].value == "1.9 deg");
    CHECK(numbers[5].value == "1.00 g");
    CHECK(flight_readouts(sim::aircraft_kind("500md"), level, {}).front().name == "collective");
}
