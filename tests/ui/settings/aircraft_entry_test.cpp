#include "sim/base/error.h"
#include "ui/settings/aircraft_entry.h"

#include <catch2/catch.hpp>

using namespace octant;
using ui::settings::AircraftEntry;
using ui::settings::parse_aircraft_entry;

TEST_CASE("an aircraft may have a path of its own and a time at which it begins") {
    const AircraftEntry plain = parse_aircraft_entry("f15");
    CHECK(plain.shape == "f15");
    CHECK_FALSE(plain.path);
    const AircraftEntry own = parse_aircraft_entry("500md=turn@10s");
    CHECK(own.shape == "500md");
    CHECK(own.path == "turn");
    CHECK(own.from_s == 10.0);
    CHECK(parse_aircraft_entry("a/b.obj=c.csv").path == "c.csv");
    for (const char* text : {"f15", "500md=turn@10s", "f15=pop-up", "a/b.obj=tracks/c.csv@0.5s"}) {
        CHECK(text_of(parse_aircraft_entry(text)) == text);
    }
    for (const char* text : {"f15=", "=turn", "f15=turn@", "f15=turn@later", "f15=turn@-1s"}) {
        CHECK_THROWS_AS(parse_aircraft_entry(text), Error);
    }
}
