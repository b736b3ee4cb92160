#include "visuals/planning/id_plan.h"
#include "visuals/planning/planner.h"
#include "visuals/scene/camera_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <optional>
#include <vector>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::planning;
using namespace octant::visuals::scene;

namespace {

Camera cockpit_camera(const sim::AircraftState& state) {
    ViewSettings view;
    view.kind = View::Cockpit;
    const GroundHeight no_ground = [](double, double) { return std::optional<double>(); };
    return camera_of(view, state, {}, {}, {}, no_ground);
}

} // namespace

TEST_CASE("plans of the cockpit view have a head-up display unless it is off, others none") {
    Scene scene;
    scene.ground = cell_ground(4, 100.0, [](double, double) { return 50.0; });
    scene.add_model(convex_aircraft(box_model({10.0, 3.0, 2.0})));
    scene.aircraft = {0};
    const std::vector<sim::AircraftState> states{state_at({0.0, 0.0, 300.0})};
    Settings settings = plain_settings();
    Planner planner(scene, settings);
    const auto drawn = [&](View view, bool wanted) {
        settings.view.kind = view;
        settings.view.head_up_display = wanted;
        return planner.plan({cockpit_camera(states.front()), states}).plan.overlay.indices.size();
    };
    CHECK(drawn(View::Chase, true) == 0);
    CHECK(drawn(View::Cockpit, false) == 0);
    CHECK(drawn(View::Cockpit, true) > 0);
    IdPlan ids(scene);
    const FramePlan& numbers = ids.of(planner.plan({cockpit_camera(states.front()), states}).plan);
    CHECK(std::ranges::count(numbers.steps, PaintStep::Content::Overlay, &PaintStep::content) == 0);
}
