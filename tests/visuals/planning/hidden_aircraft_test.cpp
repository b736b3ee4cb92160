#include <catch2/catch.hpp>

#include <algorithm>

#include "plan_painter.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::planning;
using namespace octant::visuals::scene;

TEST_CASE("aircraft that are not there are in no plan, wherever the eye looks") {
    Scene scene;
    scene.ground = cell_ground(8, 60.0, [](double, double) { return 0.0; });
    scene.add_model(convex_aircraft(box_model({10.0, 3.0, 2.0})));
    scene.aircraft.assign(16, 0);
    std::vector<sim::AircraftState> states(16, state_at({0.0, 0.0, 100.0}));
    for (sim::AircraftState& state : states) { state.is_present = false; }
    states[3] = state_at({0.0, 0.0, 100.0});
    const Camera camera = camera_looking_at({0.0, -1.0, 300.0}, states[3].position_m);

    for (const HiddenSurface method : {HiddenSurface::Octant, HiddenSurface::DepthBuffer}) {
        Settings settings = plain_settings();
        settings.surface.hidden_surface = method;
        Planner planner(scene, settings);
        const auto [plan, counts] = planner.plan({camera, states});
        REQUIRE(plan.aircraft.size() == 1);
        CHECK(plan.aircraft.front().first_part == 3);
        CHECK(counts.aircraft_polygons == 6);
        CHECK(counts.cuts == 0);
        CHECK(counts.overlap_groups == 0);
    }
}
