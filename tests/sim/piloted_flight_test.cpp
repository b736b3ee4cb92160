// What holds for every aircraft flown by hand.

#include "sim/flight_models.h"
#include "tests/sim/hand_flights.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace octant;
using namespace octant::tests;
using sim::PilotControls;

namespace {

bool is_helicopter(const sim::AircraftKind& kind) { return kind.flight_model == sim::FlightModel::Helicopter; }

double speed_of(const sim::AircraftKind& kind) { return is_helicopter(kind) ? 30.0 : 200.0; }

} // namespace

TEST_CASE("ten minutes of wild controls leave finite states with unit attitudes") {
    for (const sim::AircraftKind& kind : sim::aircraft_kinds()) {
        for (const std::uint32_t seed : {1U, 2U}) {
            const auto flight =
                sim::make_piloted_flight(kind, sim::trimmed_state(kind, {0, 0, 3000}, 1.0, speed_of(kind)));
            bool good = true;
            double fastest = 0.0;
            fly(*flight, 600, WildPilot(seed), [&](const sim::PilotedFlight& f) {
                good = good && is_finite(f.state());
                fastest = std::max(fastest, speed_mps(f));
            });
            CHECK(good);
            CHECK(fastest < (is_helicopter(kind) ? 100.0 : 800.0));
        }
    }
}

TEST_CASE("the same start and controls give the same bits") {
    for (const sim::AircraftKind& kind : sim::aircraft_kinds()) {
        const auto start = sim::trimmed_state(kind, {5, 6, 1000}, 2.0, speed_of(kind));
        const auto a = sim::make_piloted_flight(kind, start);
        const auto b = sim::make_piloted_flight(kind, start);
        WildPilot pilot_a(9);
        WildPilot pilot_b(9);
        bool same = true;
        for (int i = 0; i < 7200; ++i) {
            a->step(pilot_a(0));
            b->step(pilot_b(0));
            same = same && same_bits(a->state(), b->state());
        }
        CHECK(same);
    }
}

TEST_CASE("controls that are not numbers count as 0, those out of range as the end of it") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const sim::AircraftKind& kind : sim::aircraft_kinds()) {
        const auto start = sim::trimmed_state(kind, {0, 0, 1000}, 0.0, speed_of(kind));
        const auto odd = sim::make_piloted_flight(kind, start);
        const auto even = sim::make_piloted_flight(kind, start);
        hold(*odd, 0.5, {nan, nan, nan, nan});
        hold(*even, 0.5, {0, 0, 0, 0});
        hold(*odd, 0.5, {inf, -5, -inf, 7});
        hold(*even, 0.5, {1, -1, -1, 1});
        CHECK(same_bits(odd->state(), even->state()));
    }
}

TEST_CASE("times are those of the steps, exactly") {
    for (const sim::AircraftKind& kind : sim::aircraft_kinds()) {
        const auto flight = sim::make_piloted_flight(kind, sim::trimmed_state(kind, {0, 0, 1000}, 0.0, speed_of(kind)));
        for (long step = 1; step < 5000; ++step) {
            flight->step({});
            REQUIRE(flight->state().time_s == sim::time_of_step(step));
        }
    }
}

TEST_CASE("positions go as the velocities say") {
    for (const sim::AircraftKind& kind : sim::aircraft_kinds()) {
        const auto flight = sim::make_piloted_flight(kind, sim::trimmed_state(kind, {0, 0, 3000}, 0.3, speed_of(kind)));
        sim::AircraftState before = flight->state();
        double worst = 0.0;
        fly(*flight, 60, WildPilot(4), [&](const sim::PilotedFlight& f) {
            const sim::AircraftState& now = f.state();
            const glm::dvec3 moved = now.position_m - before.position_m;
            const glm::dvec3 meant = 0.5 * sim::step_s * (now.velocity_mps + before.velocity_mps);
            worst = std::max(worst, glm::length(moved - meant));
            before = now;
        });
        CHECK(worst < 1e-9);
    }
}

TEST_CASE("any start flies: standing still, backwards, upside down, without a load factor") {
    for (const sim::AircraftKind& kind : sim::aircraft_kinds()) {
        for (const double speed : {-60.0, 0.0, 5.0, 90.0}) {
            for (const double roll : {0.0, 3.0}) {
                for (const double pitch : {-1.5, 0.0, pi / 2}) {
                    sim::AircraftState start;
                    start.position_m = {0, 0, 4000};
                    start.velocity_mps = speed * direction_from_heading(1.0);
                    start.body_to_world = body_to_world_from_euler({1.0, pitch, roll});
                    start.load_factor = 0.0;
                    const auto flight = sim::make_piloted_flight(kind, start);
                    CHECK(flight->trim_throttle() >= 0.0);
                    CHECK(flight->trim_throttle() <= 1.0);
                    bool good = true;
                    fly(
                        *flight, 30,
                        [](double) {
                            return PilotControls{0, 0, 0, 0.5};
                        },
                        [&](const sim::PilotedFlight& f) { good = good && is_finite(f.state()); });
                    CHECK(good);
                }
            }
        }
    }
}
