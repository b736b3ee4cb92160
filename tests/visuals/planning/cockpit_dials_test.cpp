#include "models/polygons/obj_reader.h"
#include "sim/aircraft_kind.h"
#include "visuals/planning/aircraft_model.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace octant;
using namespace octant::visuals;

TEST_CASE("both cockpits have room for five dials that are read at 720 lines") {
    const std::filesystem::path folder = std::filesystem::path(OCTANT_SOURCE_DIR) / "models";
    for (const sim::AircraftKind& kind : sim::aircraft_kinds()) {
        INFO(kind.name);
        const auto layout = planning::dials_of(models::polygons::read_obj(folder / kind.cockpit_file), kind.limits);
        REQUIRE(layout.dials.size() == 5);
        CHECK(layout.speed_kt.max > 0.0);
        const double px = 360.0 / std::tan(0.5 * 45.0 * 3.14159265358979 / 180.0);
        for (const overlay::Dial& dial : layout.dials) {
            const glm::dvec2 middle_px = px * glm::dvec2(dial.centre_m.y, dial.centre_m.z) / dial.centre_m.x;
            const double radius_px = px * dial.radius_m / dial.centre_m.x;
            CHECK(radius_px > 40.0);
            CHECK(middle_px.y + radius_px < 361.0); // all of it is in the picture
            CHECK(std::ranges::none_of(layout.dials, [&](const overlay::Dial& other) {
                return &other != &dial && glm::distance(other.centre_m, dial.centre_m) < other.radius_m + dial.radius_m;
            }));
        }
    }
}

TEST_CASE("a cockpit without parts named after dials has none") {
    const std::filesystem::path folder = std::filesystem::path(OCTANT_SOURCE_DIR) / "models";
    const auto layout =
        planning::dials_of(models::polygons::read_obj(folder / "concave.obj"), sim::aircraft_kind("f15").limits);
    CHECK(layout.dials.empty());
}
