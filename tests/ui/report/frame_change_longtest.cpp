#include "tests/ui/report/generated_flights.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>
#include <fmt/format.h>

using namespace octant;
using namespace octant::ui::report;

namespace {

struct Kind {
    const char* name;
    Machine machine;
};

const std::vector<Kind> kinds{
    {"quiet", {0.02, 0.02, 0.3, 0.01, 40.0, 0.002}},
    {"drifts by 10 % a round", {0.1, 0.04, 0.5, 0.05, 40.0, 0.003}},
    {"drifts by 30 %, bursts in a fifth of the frames", {0.3, 0.1, 0.5, 0.2, 10.0, 0.02}},
    {"noise with a memory of 100 frames", {0.1, 0.2, 0.99, 0.05, 40.0, 0.01}},
    {"flights differ by 10 %", {0.1, 0.04, 0.5, 0.05, 40.0, 0.1}},
};

/// P50 of each flight, flown in rounds of random order.
std::vector<Trial> medians_of(const Rounds& flown, RandomGenerator& dice) {
    std::vector<Trial> trials;
    for (std::size_t r = 0; r < flown.before.size(); ++r) {
        const Trial old_flight{Side::Old, std::log(median_of(flown.before[r].frame_ms))};
        const Trial new_flight{Side::New, std::log(median_of(flown.after[r].frame_ms))};
        const bool is_old_first = dice.next() < 0.5;
        trials.push_back(is_old_first ? old_flight : new_flight);
        trials.push_back(is_old_first ? new_flight : old_flight);
    }
    return trials;
}

} // namespace

TEST_CASE("of 10,000 comparisons of a program with itself at most 5.5 in 100 show a change, and 1 in 100 fail a gate") {
    constexpr int trials_each = 500;
    const double gate = std::log(1.05);
    int all = 0;
    int all_changed = 0;
    int all_failed = 0;
    for (const Kind& kind : kinds) {
        for (const std::size_t rounds : {3U, 5U, 7U, 10U}) {
            RandomGenerator dice(rounds);
            int changed = 0;
            int failed = 0;
            for (int trial = 0; trial < trials_each; ++trial) {
                const Rounds flown = rounds_of(dice, kind.machine, rounds);
                changed += frame_change(flown.before, flown.after).change->excludes_zero() ? 1 : 0;
                failed += change_of(medians_of(flown, dice))->low > gate ? 1 : 0;
            }
            std::fputs(fmt::format("{}, {} rounds: {} of {} changed, {} fail a gate of 5 %\n", kind.name, rounds,
                           changed, trials_each, failed)
                           .c_str(),
                stdout);
            CHECK(changed <= 40); // 5 % of 500, and three standard deviations
            all += trials_each;
            all_changed += changed;
            all_failed += failed;
        }
    }
    CHECK(all == 10000);
    CHECK(all_changed <= 550);
    CHECK(all_failed <= 100);
}
