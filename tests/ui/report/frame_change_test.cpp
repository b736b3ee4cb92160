#include "tests/ui/report/generated_flights.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <utility>
#include <vector>

using namespace octant;
using namespace octant::ui::report;

namespace {

/// How many of so many comparisons of the same program show a change.
int changes_of_nothing(const Machine& machine, std::size_t rounds, int trials) {
    RandomGenerator dice(20 + rounds);
    int changed = 0;
    for (int trial = 0; trial < trials; ++trial) {
        const Rounds flown = rounds_of(dice, machine, rounds);
        changed += frame_change(flown.before, flown.after).change->excludes_zero() ? 1 : 0;
    }
    return changed;
}

} // namespace

TEST_CASE("a change of a stage in some frames is told with its size, its stage and its frames") {
    RandomGenerator dice(1);
    const Rounds flown = rounds_of(dice, {}, 9, {1, 0.3, 100, 139});
    const FrameChange change = frame_change(flown.before, flown.after);
    REQUIRE(change.change);
    CHECK(change.pairing == Pairing::Rounds);
    CHECK(change.old_runs == 9);
    CHECK(change.frames == 190);
    CHECK(change.change->excludes_zero());
    REQUIRE(change.frames_changed);
    CHECK(std::abs(change.frames_changed->first_frame - (first_frame + 100)) <= 2);
    CHECK(std::abs(change.frames_changed->last_frame - (first_frame + 139)) <= 2);
    CHECK(change.frames_changed->share == Approx(0.3).margin(0.04));
    REQUIRE(change.stage_changed);
    CHECK(stage_names[change.stage_changed->stage] == "plan");
    CHECK(change.stage_changed->change_ms == Approx(change.frames_changed->change_ms).epsilon(0.1));
}

TEST_CASE("a change of all frames seldom names some, and its interval holds it") {
    RandomGenerator dice(2);
    int held = 0;
    int named = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Rounds flown = rounds_of(dice, {}, 9, {2, 0.02});
        const FrameChange change = frame_change(flown.before, flown.after);
        named += change.frames_changed ? 1 : 0;
        held += change.low_share() <= 0.02 && change.high_share() >= 0.02 ? 1 : 0;
    }
    CHECK(held >= 36);
    CHECK(named <= 2);
}

TEST_CASE("a machine that drifts by tenths from round to round and holds frames up does not hide 2 percent") {
    RandomGenerator dice(3);
    int found = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Rounds flown = rounds_of(dice, {}, 9, {1, 0.02});
        const FrameChange change = frame_change(flown.before, flown.after);
        found += change.change->low > 0.0 && change.stage_changed && change.stage_changed->stage == 1 ? 1 : 0;
    }
    CHECK(found >= 32); // four of five
}

TEST_CASE("the same program is seldom said to have changed, on machines of every kind and with few rounds or many") {
    constexpr int trials = 200;
    for (const Machine& machine : {Machine{}, Machine{0.3, 0.3, 0.9, 0.2, 10.0, 0.1}, Machine{0.0, 0.01, 0.0, 0.0}}) {
        for (const std::size_t rounds : {3U, 4U, 6U, 9U}) {
            INFO(machine.drift << " of drift, " << rounds << " rounds");
            CHECK(changes_of_nothing(machine, rounds, trials) <= 19); // 5 % of 200, and three standard deviations
        }
    }
}

TEST_CASE("flights one after the other, with other frames or too few, are compared as far as that goes") {
    RandomGenerator dice(4);
    const Machine calm{0.0, 0.01, 0.0, 0.0};
    Rounds flown = rounds_of(dice, calm, 3, {1, 0.3});
    const std::vector<Side> one_after_the_other{Side::Old, Side::Old, Side::Old, Side::New, Side::New, Side::New};
    const FrameChange slower = frame_change(flown.before, flown.after, one_after_the_other);
    CHECK(slower.pairing == Pairing::Frames);
    CHECK(slower.change->low > 0.0);
    CHECK(slower.share() == Approx(0.3).margin(0.03));
    const FrameChange figures = frame_change(flown.before, flown.after, one_after_the_other, false);
    CHECK(figures.pairing == Pairing::Figures);
    CHECK(figures.share() == Approx(0.3).margin(0.05));
    const FrameChange few = frame_change(std::span(flown.before).first(2), std::span(flown.after).first(2));
    CHECK_FALSE(few.change);
    CHECK(few.share() == Approx(0.3).margin(0.03));
    for (auto& stage : flown.after[0].stage_ms) { stage.clear(); }
    CHECK_FALSE(frame_change(flown.before, flown.after).stage_changed);
}

TEST_CASE("frames in which a program was stopped are left out, whatever their times") {
    RandomGenerator dice(5);
    const Machine calm{0.0, 0.01, 0.0, 0.0};
    Rounds flown = rounds_of(dice, calm, 6);
    const FrameChange without = frame_change(flown.before, flown.after);
    for (FrameTimes& flight : flown.after) {
        flight.paused.assign(flight.frame_ms.size(), false);
        for (std::size_t k = 0; k < flight.frame_ms.size(); k += 3) { // so many that no median shows them
            flight.paused[k] = true;
            flight.frame_ms[k] *= 1.02;
        }
    }
    const FrameChange same = frame_change(flown.before, flown.after);
    CHECK(same.share() == Approx(without.share()).margin(0.002));
    CHECK_FALSE(same.change->low > 0.0);
    for (FrameTimes& flight : flown.after) { flight.paused.clear(); }
    CHECK(frame_change(flown.before, flown.after).share() == Approx(without.share() + 0.0067).margin(0.002));
    // By medians alone, too.
    for (FrameTimes& flight : flown.after) {
        flight.paused.assign(flight.frame_ms.size(), false);
        for (std::size_t k = 0; k < flight.frame_ms.size() / 2; ++k) {
            flight.paused[k] = true;
            flight.frame_ms[k] += 40.0;
        }
    }
    const FrameChange figures = frame_change(flown.before, flown.after, {}, false);
    CHECK(figures.frames == 190);
    CHECK(std::abs(figures.share()) < 0.15);
    // Where all frames have pauses they are compared all the same.
    for (FrameTimes& flight : flown.after) { flight.paused.assign(flight.frame_ms.size(), true); }
    CHECK(frame_change(flown.before, flown.after).change);
}

TEST_CASE("a change of some frames is found however many flights each side has, and none where there is none") {
    RandomGenerator dice(6);
    const Machine calm{0.0, 0.02, 0.5, 0.05, 40.0, 0.002};
    for (const auto& [old_runs, new_runs] : {std::pair(3U, 10U), std::pair(10U, 3U), std::pair(4U, 5U)}) {
        INFO(old_runs << " and " << new_runs << " flights");
        std::vector<Side> order(old_runs, Side::Old);
        order.insert(order.end(), new_runs, Side::New);
        int found = 0;
        int none = 0;
        double sum = 0.0;
        for (int trial = 0; trial < 20; ++trial) {
            const auto flown = [&](unsigned count, Delay delay) {
                std::vector<FrameTimes> flights;
                for (unsigned i = 0; i < count; ++i) { flights.push_back(flight_of(dice, calm, 0.0, 190, delay)); }
                return flights;
            };
            const std::vector<FrameTimes> before = flown(old_runs, {});
            const FrameChange slower = frame_change(before, flown(new_runs, {1, 0.4, 100, 139}), order);
            found += slower.change->low > 0.0 && slower.frames_changed ? 1 : 0;
            sum += slower.share() / 20.0;
            none += frame_change(before, flown(new_runs, {}), order).change->excludes_zero() ? 1 : 0;
        }
        CHECK(found >= 18);
        CHECK(sum > 0.04); // 0.4 of a fifth of the frames, which are short ones
        CHECK(none <= 4);
    }
}
