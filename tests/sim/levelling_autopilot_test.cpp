#include "sim/flight_models.h"
#include "sim/piloted_flight.h"
#include "tests/sim/hand_flights.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>

using namespace octant;
using namespace octant::sim;
using namespace octant::tests;

namespace {

/// Flies for so long with these controls, then levels off.
struct Levelled {
    double seconds = 0.0;
    double max_turn_radps = 0.0;
    double max_load_factor = 0.0;
    bool stalled_again = false;
    std::unique_ptr<PilotedFlight> flight;
};

Levelled levelled(const char* name, double speed_mps, const PilotControls& controls) {
    const AircraftKind& kind = aircraft_kind(name);
    Levelled end;
    end.flight = make_piloted_flight(kind, trimmed_state(kind, {0, 0, 3000}, 1.0, speed_mps));
    PilotedFlight& flight = *end.flight;
    hold(flight, 3, controls);
    LevellingAutopilot levelling(kind, flight.state());
    constexpr int longest_steps = 60 * steps_per_second;
    for (int i = 0; i < longest_steps && !levelling.is_done(); ++i) {
        const AircraftState before = flight.state();
        const bool stalled = flight.warnings().stalled;
        flight.step(levelling.controls(before));
        const AircraftState& after = flight.state();
        end.max_turn_radps = std::max(end.max_turn_radps, turn_radps(before.body_to_world, after.body_to_world));
        end.max_load_factor = std::max(end.max_load_factor, after.load_factor);
        end.stalled_again = end.stalled_again || (!stalled && flight.warnings().stalled);
        end.seconds += step_s;
    }
    return end;
}

} // namespace

TEST_CASE("levelling flies an aircraft level from any attitude, within its limits") {
    struct Case {
        const char* name;
        double speed_mps;
        PilotControls controls;
        double max_s;
    };

    const std::array cases{Case{"f15", 150, {0, 0.7, 0, 0.8}, 15}, Case{"f15", 150, {-0.3, 0, 0, 0.5}, 15},
        Case{"f15", 150, {-1, 1, 0, 0.3}, 15}, Case{"f15", 250, {0.5, 0.5, 0, 0.9}, 20},
        Case{"f15", 150, {1, 0, 0, 0}, 40}, Case{"500md", 40, {0, 0.7, 0, 0.8}, 10},
        Case{"500md", 40, {0.5, 0.2, 0, 0.9}, 10}, Case{"500md", 40, {-1, 1, 0, 0.3}, 10},
        Case{"500md", 0, {0, 0, 1, 0.2}, 15}};
    for (const Case& each : cases) {
        CAPTURE(each.name, each.controls.pitch, each.controls.roll);
        const Levelled end = levelled(each.name, each.speed_mps, each.controls);
        const AircraftLimits& limits = aircraft_kind(each.name).limits;
        CHECK(end.seconds < each.max_s);
        CHECK(end.max_turn_radps < limits.roll_rate_radps + 1.3);
        CHECK(end.max_load_factor <= limits.max_load_factor + 0.1);
        CHECK_FALSE(end.stalled_again);
        // It stays level, and as fast, with the controls that it was left with.
        const double height_m = end.flight->state().position_m.z;
        const double speed = speed_mps(*end.flight);
        PilotControls left;
        left.throttle = make_piloted_flight(aircraft_kind(each.name), end.flight->state())->trim_throttle();
        hold(*end.flight, 10, left);
        CHECK(std::abs(angles_of(*end.flight).roll_rad) < rad_from_deg(0.5));
        CHECK(end.flight->state().position_m.z == Approx(height_m).margin(8));
        CHECK(speed_mps(*end.flight) == Approx(speed).margin(3));
    }
}
