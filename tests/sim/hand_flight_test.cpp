// What holds for every aircraft flown by hand.

#include "sim/hand_flight.h"
#include "tests/sim/hand_flights.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace octant;
using namespace octant::tests;
using sim::PilotControls;

namespace {

const char* const aircraft[] = {"f15", "500md"};

double speed_of(const char* name) {
    return std::string_view(name) == "f15" ? 200.0 : 30.0;
}

} // namespace

TEST_CASE("ten minutes of wild controls leave finite states with unit attitudes") {
    for (const char* name : aircraft) {
        for (const std::uint32_t seed : {1U, 2U}) {
            const auto flight =
                sim::hand_flight(name, sim::trimmed_state(name, {0, 0, 3000}, 1.0, speed_of(name)));
            bool good = true;
            double fastest = 0.0;
            fly(*flight, 600, WildPilot(seed), [&](const sim::HandFlight& f) {
                good = good && is_finite(f.state());
                fastest = std::max(fastest, speed_mps(f));
            });
            CHECK(good);
            CHECK(fastest < (std::string_view(name) == "f15" ? 800.0 : 100.0));
        }
    }
}

TEST_CASE("the same start and controls give the same bits") {
    for (const char* name : aircraft) {
        const auto start = sim::trimmed_state(name, {5, 6, 1000}, 2.0, speed_of(name));
        const auto a = sim::hand_flight(name, start);
        const auto b = sim::hand_flight(name, start);
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
    for (const char* name : aircraft) {
        const auto start = sim::trimmed_state(name, {0, 0, 1000}, 0.0, speed_of(name));
        const auto odd = sim::hand_flight(name, start);
        const auto even = sim::hand_flight(name, start);
        hold(*odd, 0.5, {nan, nan, nan, nan});
        hold(*even, 0.5, {0, 0, 0, 0});
        hold(*odd, 0.5, {inf, -5, -inf, 7});
        hold(*even, 0.5, {1, -1, -1, 1});
        CHECK(same_bits(odd->state(), even->state()));
    }
}

TEST_CASE("times are those of the steps, exactly") {
    for (const char* name : aircraft) {
        const auto flight =
            sim::hand_flight(name, sim::trimmed_state(name, {0, 0, 1000}, 0.0, speed_of(name)));
        for (long step = 1; step < 5000; ++step) {
            flight->step({});
            REQUIRE(flight->state().time_s == sim::time_of_step(step));
        }
    }
}

TEST_CASE("positions go as the velocities say") {
    for (const char* name : aircraft) {
        const auto flight =
            sim::hand_flight(name, sim::trimmed_state(name, {0, 0, 3000}, 0.3, speed_of(name)));
        sim::AircraftState before = flight->state();
        double worst = 0.0;
        fly(*flight, 60, WildPilot(4), [&](const sim::HandFlight& f) {
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
    for (const char* name : aircraft) {
        for (const double speed : {-60.0, 0.0, 5.0, 90.0}) {
            for (const double roll : {0.0, 3.0}) {
                for (const double pitch : {-1.5, 0.0, pi / 2}) {
                    sim::AircraftState start;
                    start.position_m = {0, 0, 4000};
                    start.velocity_mps = speed * direction_from_heading(1.0);
                    start.body_to_world = body_to_world_from_euler({1.0, pitch, roll});
                    start.load_factor = 0.0;
                    const auto flight = sim::hand_flight(name, start);
                    CHECK(flight->trim_throttle() >= 0.0);
                    CHECK(flight->trim_throttle() <= 1.0);
                    bool good = true;
                    fly(
                        *flight,
                        30,
                        [](double) {
                            return PilotControls{0, 0, 0, 0.5};
                        },
                        [&](const sim::HandFlight& f) { good = good && is_finite(f.state()); });
                    CHECK(good);
                }
            }
        }
    }
}
