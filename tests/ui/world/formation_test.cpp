#include "sim/base/axes.h"
#include "ui/world/formation.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <vector>

using namespace octant;

namespace {

/// Least distance between any two aircraft of a formation, metres.
double min_distance_m(int aircraft, double radius_m) {
    const ui::world::Formation formation(aircraft, radius_m);
    sim::AircraftState leader;
    leader.body_to_world = body_to_world_from_euler({0.7, 0.2, 0.4});
    std::vector<glm::dvec3> places_m = {leader.position_m};
    double min_m = std::numeric_limits<double>::infinity();
    for (int number = 1; number < aircraft; ++number) {
        const glm::dvec3 place_m = formation.wingman_state(leader, number).position_m;
        for (const glm::dvec3& other_m : places_m) { min_m = std::min(min_m, glm::distance(place_m, other_m)); }
        places_m.push_back(place_m);
    }
    return min_m;
}

} // namespace

TEST_CASE("aircraft of a formation keep apart, however many there are") {
    for (const int aircraft : {2, 3, 9, 10, 16, 100, 1000}) {
        INFO(aircraft << " aircraft");
        CHECK(min_distance_m(aircraft, 10.0) >= 17.0 - 1e-9);
    }
}

TEST_CASE("no aircraft of a formation flies below its leader") {
    const ui::world::Formation formation(1000, 10.0);
    const sim::AircraftState leader;
    for (int number = 1; number < 1000; ++number) {
        REQUIRE(formation.wingman_state(leader, number).position_m.z >= leader.position_m.z);
    }
}
