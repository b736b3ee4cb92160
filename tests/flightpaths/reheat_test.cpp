#include "flightpaths/recorded_track.h"
#include "sim/base/units.h"
#include "sim/flight_models.h"
#include "tests/flightpaths/shipped_figures.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <string>

using namespace octant;

namespace {

/// Least and most reheat of an F-15 along a path, but for half a second at its ends.
struct Reheat {
    double least = 1.0;
    double most = 0.0;
};

Reheat reheat_along(const sim::Trajectory& path) {
    const sim::AircraftKind& f15 = sim::aircraft_kind("f15");
    Reheat reheat;
    for (double time_s = path.start_s() + 0.5; time_s < path.end_s() - 0.5; time_s += 0.05) {
        const double share = sim::reheat_fraction(&f15, path.state_at(time_s));
        reheat.least = std::min(reheat.least, share);
        reheat.most = std::max(reheat.most, share);
    }
    return reheat;
}

Reheat reheat_of_file(const std::string& name) {
    return reheat_along(
        flightpaths::read_recorded_track(std::string(OCTANT_SOURCE_DIR) + "/tests/flightpaths/tracks/" + name)
            .trajectory);
}

} // namespace

TEST_CASE("a zoom that pays height with speed needs no reheat, a dive at full power does") {
    // From 220 to 163 m/s in 10 s at 30 degrees: 5.7 m/s2 lost, 4.9 by weight, the rest by drag.
    CHECK(reheat_of_file("ballistic-zoom.csv").most == 0.0);
    // From 180 to 270 m/s at -20 degrees: 9.3 m/s2 gained, 3.4 of them by weight. For the rest 17 t need 101 kN, and 25
    // to 50 kN for drag; dry thrust is 0.6 of 171 to 231 kN.
    CHECK(reheat_of_file("full-power-dive.csv").least > 0.05);
}

TEST_CASE("of the built-in paths only the pop-up needs reheat, while it gains energy or pulls") {
    // At a constant 250 m/s and 1 to 4 g the drag is 40 to 75 kN, less than any dry thrust.
    for (const std::string name : {"straight", "jinking", "turn"}) {
        INFO(name);
        CHECK(reheat_along(tests::flown("f15-" + name).trajectory).most == 0.0);
    }
    const sim::Trajectory pop_up = tests::flown("f15-pop-up").trajectory;
    CHECK(reheat_along(pop_up).most > 0.1);
    const sim::AircraftKind& f15 = sim::aircraft_kind("f15");
    const auto energy_m2ps2 = [&](double time_s) {
        const sim::AircraftState state = pop_up.state_at(time_s);
        const double speed_mps = glm::length(state.velocity_mps);
        return gravity_mps2 * state.position_m.z + 0.5 * speed_mps * speed_mps;
    };
    for (double time_s = pop_up.start_s() + 1.0; time_s < pop_up.end_s() - 1.0; time_s += 0.05) {
        const sim::AircraftState state = pop_up.state_at(time_s);
        const double gained = energy_m2ps2(time_s + 0.5) - energy_m2ps2(time_s - 0.5);
        if (gained < 0.0 && state.load_factor < 3.0) { CHECK(sim::reheat_fraction(&f15, state) == 0.0); }
    }
}

TEST_CASE("a helicopter has no reheat, and an unknown shape that of the F-15") {
    sim::AircraftState state;
    state.velocity_mps = {200.0, 0.0, 50.0};
    state.speed_rate_mps2 = 9.0;
    CHECK(sim::reheat_fraction(&sim::aircraft_kind("500md"), state) == 0.0);
    const double share = sim::reheat_fraction(&sim::aircraft_kind("f15"), state);
    CHECK(share > 0.5);
    CHECK(sim::reheat_fraction(nullptr, state) == share);
    state.velocity_mps = glm::dvec3(0.0);
    CHECK(sim::reheat_fraction(nullptr, state) == 0.0);
}
