#include "flightpaths/derived_motion.h"
#include "sim/base/axes.h"
#include "sim/base/earth_frame.h"
#include "sim/base/units.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>

using namespace octant;

TEST_CASE("a path carried to another frame stays over its places, with its true headings") {
    const TransverseMercator from({48.0, 10.0});
    const TransverseMercator to({48.0, 8.0}); // 150 km west: north differs by 1.5 degrees
    sim::AircraftState state;
    state.body_to_world = body_to_world_from_euler({rad_from_deg(30.0), 0.1, 0.2});
    state.velocity_mps = glm::dvec3(0.0, 100.0, 5.0);
    sim::AircraftState later = state;
    later.time_s = 1.0;
    later.position_m = glm::dvec3(3000.0, 40000.0, 700.0);
    const sim::Trajectory carried = flightpaths::reprojected(sim::Trajectory({state, later}), from, to);
    const sim::AircraftState& first = carried.samples()[0];
    const sim::AircraftState& second = carried.samples()[1];
    CHECK(glm::length(first.position_m) < 1e-6);
    const GeoPosition there = from.geo_from_local({3000.0, 40000.0});
    const glm::dvec2 expected_m = to.local_from_geo(there) - to.local_from_geo({48.0, 10.0});
    CHECK(glm::distance(glm::dvec2(second.position_m), expected_m) < 1e-6);
    CHECK(second.position_m.z == 700.0);
    const double turn_rad = to.place_of({48.0, 10.0}).north_bearing_rad;
    CHECK(deg_from_rad(turn_rad) == Approx(-1.4863).margin(1e-3)); // asin-like: 2 deg * sin 48
    const EulerAngles angles = euler_from_body_to_world(first.body_to_world);
    CHECK(angles.heading_rad == Approx(rad_from_deg(30.0) + turn_rad));
    CHECK(angles.roll_rad == Approx(0.2));
    CHECK(first.velocity_mps.x == Approx(100.0 * std::sin(turn_rad)));
    CHECK(first.velocity_mps.z == 5.0);
}

TEST_CASE("a track on Mars keeps its latitudes, and its speed fits its places") {
    const TransverseMercator from({20.0, 10.0});
    const TransverseMercator to({20.0, 10.0, {3396190.0, 0.0}});
    sim::AircraftState state;
    state.velocity_mps = glm::dvec3(100.0, 0.0, 7.0);
    sim::AircraftState later = state;
    later.time_s = 10.0;
    later.position_m = glm::dvec3(1000.0, 0.0, 70.0);
    const sim::Trajectory carried = flightpaths::reprojected(sim::Trajectory({state, later}), from, to);
    const sim::AircraftState& second = carried.samples()[1];
    CHECK(second.position_m.x == Approx(1000.0 * 3396190.0 / 6378137.0).epsilon(2e-3));
    CHECK(second.velocity_mps.x * 10.0 == Approx(second.position_m.x).epsilon(2e-3));
    CHECK(second.velocity_mps.z == 7.0);
}
