#include "sim/base/axes.h"
#include "sim/base/random_generator.h"
#include "sim/base/units.h"
#include "sim/links/live_traffic.h"
#include "sim/links/sender_clock.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace octant;
using namespace octant::sim;
using namespace octant::sim::links;

namespace {

/// A flight whose truth is known: straight, or a level turn at 3 g.
struct Truth {
    double speed_mps = 150.0;
    double turn_radps = 0.0;

    glm::dvec3 position_m(double t) const {
        if (turn_radps == 0.0) { return {speed_mps * t, 0.0, 1000.0}; }
        const double radius_m = speed_mps / turn_radps;
        return {radius_m * std::sin(turn_radps * t), radius_m * (std::cos(turn_radps * t) - 1.0), 1000.0};
    }

    Fix fix(double t) const {
        Fix fix;
        const double heading = 0.5 * pi + turn_radps * t;
        fix.attitude = {wrapped_to_two_pi(heading), 0.0, 0.0};
        fix.velocity_ned_mps = speed_mps * glm::dvec3(std::cos(heading), std::sin(heading), 0.0);
        fix.body_rates_radps = glm::dvec3(0.0, 0.0, turn_radps);
        return fix;
    }
};

/// What lies between sender and receiver.
struct Way {
    double rate_hz = 60.0;
    double jitter_s = 0.0;
    double lost = 0.0;    ///< share
    double swapped = 0.0; ///< share of packets that come after their successor
    double burst_s = 0.0; ///< packets wait for a time that is a multiple of it
    bool with_velocity = true;
    bool with_clock = false;
};

struct Arrival {
    double sent_s = 0.0;
    double arrival_s = 0.0;
};

std::vector<Arrival> arrivals(const Way& way, double length_s) {
    RandomGenerator dice(7);
    std::vector<Arrival> all;
    for (int i = 0; i < static_cast<int>(length_s * way.rate_hz); ++i) {
        const double sent_s = i / way.rate_hz;
        double arrival_s = sent_s + 0.001 + way.jitter_s * dice.next();
        if (way.burst_s > 0.0) { arrival_s = std::ceil(arrival_s / way.burst_s) * way.burst_s; }
        const bool is_lost = dice.next() < way.lost;
        if (dice.next() < way.swapped) { arrival_s += 1.5 / way.rate_hz; }
        if (!is_lost) { all.push_back({sent_s, arrival_s}); }
    }
    std::stable_sort(
        all.begin(), all.end(), [](const Arrival& a, const Arrival& b) { return a.arrival_s < b.arrival_s; });
    return all;
}

struct Outcome {
    double rms_m = 0.0; ///< from the truth at the time shown
    double max_lag_s = 0.0;
    double mean_lag_s = 0.0; ///< along the flight
    double max_jump_m = 0.0;
    long late = 0;
};

/// Pictures at 60 Hz from `from_s` on.
Outcome fly(const Truth& truth, const Way& way, double delay_s, double length_s = 20.0) {
    constexpr double from_s = 3.0;
    constexpr double frame_s = 1.0 / 60.0;
    LiveVehicle vehicle({});
    const auto packets = arrivals(way, length_s);
    std::size_t next = 0;
    Outcome outcome;
    double squares = 0.0;
    int frames = 0;
    glm::dvec3 before_m(0.0);
    for (double now_s = 0.1; now_s < length_s; now_s += frame_s) {
        for (; next < packets.size() && packets[next].arrival_s <= now_s; ++next) {
            Fix fix = truth.fix(packets[next].sent_s);
            if (!way.with_velocity) { fix.velocity_ned_mps = glm::dvec3(0.0); }
            if (way.with_clock) {
                const double ticks = packets[next].sent_s * 1e6 + 4294000000.0;
                fix.ticks = static_cast<std::uint32_t>(static_cast<std::uint64_t>(ticks)); // wraps
            }
            vehicle.add(fix, truth.position_m(packets[next].sent_s), packets[next].arrival_s);
        }
        const AircraftState shown = vehicle.show(now_s, delay_s, frame_s);
        if (now_s > from_s) {
            const glm::dvec3 error_m = shown.position_m - truth.position_m(now_s - delay_s);
            const double lag_s = -glm::dot(error_m, shown.velocity_mps) / (truth.speed_mps * truth.speed_mps);
            squares += glm::dot(error_m, error_m);
            outcome.max_lag_s = std::max(outcome.max_lag_s, lag_s);
            outcome.mean_lag_s += lag_s;
            const glm::dvec3 step_m = shown.position_m - before_m;
            outcome.max_jump_m = std::max(outcome.max_jump_m, glm::length(step_m - frame_s * shown.velocity_mps));
            ++frames;
        }
        before_m = shown.position_m;
    }
    outcome.rms_m = std::sqrt(squares / frames);
    outcome.mean_lag_s /= frames;
    outcome.late = vehicle.late();
    return outcome;
}

} // namespace

TEST_CASE("a steady flight at 60 packets a second is shown within a metre of the truth") {
    for (const double delay_s : {0.0, 0.1}) {
        for (const double turn_radps : {0.0, 0.2}) {
            for (const bool with_clock : {false, true}) {
                CAPTURE(delay_s, turn_radps, with_clock);
                const Outcome outcome = fly({150.0, turn_radps}, {.with_clock = with_clock}, delay_s);
                CHECK(outcome.rms_m < 1.0);
                CHECK(outcome.max_lag_s < 0.05);
                CHECK(outcome.max_jump_m < 1.0);
                CHECK(outcome.late == 0);
            }
        }
    }
}

TEST_CASE("jitter, losses and packets out of order are stood within two metres") {
    for (const double delay_s : {0.0, 0.1}) {
        for (const double turn_radps : {0.0, 0.2}) {
            for (const bool with_clock : {false, true}) {
                CAPTURE(delay_s, turn_radps, with_clock);
                const Outcome outcome = fly({150.0, turn_radps},
                    {.jitter_s = 0.02, .lost = 0.05, .swapped = 0.02, .with_clock = with_clock}, delay_s);
                CHECK(outcome.rms_m < 2.0);
                CHECK(outcome.max_jump_m < 1.0);
                CHECK(outcome.late > 10);
            }
        }
    }
}

TEST_CASE("bursts and rates that nobody announced leave the motion smooth") {
    for (const bool with_clock : {false, true}) {
        CAPTURE(with_clock);
        const Outcome outcome = fly({150.0, 0.0}, {.rate_hz = 66.6, .burst_s = 0.088, .with_clock = with_clock}, 0.0);
        CHECK(outcome.rms_m < 2.0);
        CHECK(outcome.max_jump_m < 1.0);
    }
}

TEST_CASE("a sender that gives no velocities is shown by its positions") {
    const Outcome outcome = fly({150.0, 0.0}, {.with_velocity = false}, 0.0);
    CHECK(outcome.rms_m < 2.0);
    CHECK(outcome.max_jump_m < 1.0);
}

TEST_CASE("a silent sender's aircraft goes on for half a second and then stands") {
    const Truth truth;
    LiveVehicle vehicle({});
    for (int i = 0; i <= 120; ++i) { vehicle.add(truth.fix(i / 60.0), truth.position_m(i / 60.0), i / 60.0); }
    double last_x = 0.0;
    for (double now_s = 2.0; now_s < 4.0; now_s += 1.0 / 60.0) {
        last_x = vehicle.show(now_s, 0.0, 1.0 / 60.0).position_m.x;
        if (std::abs(now_s - 2.5) > 1e-3) { CHECK(vehicle.is_stale() == (now_s > 2.5)); }
    }
    CHECK(last_x == Approx(truth.position_m(2.5).x).margin(0.5));
}

TEST_CASE("an aircraft that is set somewhere else is there at once") {
    const Truth truth;
    LiveVehicle vehicle({});
    const glm::dvec3 elsewhere_m(0.0, 5000.0, 0.0);
    for (int i = 0; i < 300; ++i) {
        const double t = i / 60.0;
        const bool moved = i >= 200;
        vehicle.add(truth.fix(t), truth.position_m(t) + (moved ? elsewhere_m : glm::dvec3(0.0)), t);
        const AircraftState shown = vehicle.show(t, 0.0, 1.0 / 60.0);
        if (i > 30) { CHECK(std::abs(shown.position_m.y - (moved ? 5000.0 : 0.0)) < 1.0); }
    }
    CHECK(vehicle.snaps() <= 1);
}

TEST_CASE("a paused sender's aircraft stands where it is") {
    const Truth truth;
    LiveVehicle vehicle({});
    for (int i = 0; i < 300; ++i) {
        const double t = i / 60.0;
        const double flown_s = std::min(t, 2.0);
        vehicle.add(truth.fix(flown_s), truth.position_m(flown_s), t);
        const AircraftState shown = vehicle.show(t, 0.0, 1.0 / 60.0);
        if (i > 150) {
            CHECK(shown.position_m.x == Approx(300.0).margin(1.0));
            CHECK_FALSE(vehicle.is_stale());
        }
    }
}

TEST_CASE("a clock that hardly moves is late, and years without a packet are passed at once") {
    SenderClock clock;
    const auto at = [](double sent_s) {
        TimingEvidence clue;
        clue.sent_s = sent_s;
        return clue;
    };
    clock.take(0.0, at(0.0));
    CHECK(clock.take(1.0, at(1.0)) == SenderClock::Order::Next);
    CHECK(clock.take(1.1, at(1.0 + 1e-12)) == SenderClock::Order::Late);
    CHECK(clock.sender_s() == 1.0);
    CHECK(clock.take(1e12, at(2.0)) == SenderClock::Order::Next);
}
