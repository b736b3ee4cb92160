#include "sim/aircraft_kind.h"
#include "sim/base/error.h"

#include <catch2/catch.hpp>

using namespace octant;

TEST_CASE("every known aircraft is found by its name, and no other name is taken for one") {
    REQUIRE(sim::aircraft_kinds().size() == 4);
    for (const sim::AircraftKind& kind : sim::aircraft_kinds()) {
        CHECK(&sim::aircraft_kind(kind.name) == &kind);
        CHECK(sim::find_aircraft_kind(kind.name) == &kind);
    }
    CHECK(sim::find_aircraft_kind("kite") == nullptr);
    CHECK(sim::find_aircraft_kind("") == nullptr);
    CHECK_THROWS_WITH(
        sim::aircraft_kind("kite"), "expected aircraft f15 or 500md or f15-detailed or 500md-detailed, got 'kite'");
}

TEST_CASE("a pilot is handed over an aircraft at a speed that it can fly") {
    for (const sim::AircraftKind& kind : sim::aircraft_kinds()) {
        CHECK(kind.min_handover_speed_mps >= kind.limits.min_speed_mps);
        CHECK(kind.min_handover_speed_mps < kind.limits.max_speed_mps);
    }
}
