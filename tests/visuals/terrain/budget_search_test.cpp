#include "tests/visuals/terrain/ground_check.h"
#include "visuals/terrain/budget_search.h"

#include <catch2/catch.hpp>

#include <map>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;

TEST_CASE("steps are counted up to the place where the limit would be passed") {
    StepFunction steps;
    steps.start(4.0F, 100.0F);
    steps.add(0.0F, 8);
    steps.add(3.0F, -2);
    steps.add(4.0F, 5);
    steps.add(50.0F, 3);
    steps.add(50.0F, 4);
    CHECK(steps.at_low() == 6);
    CHECK(steps.at_high() == 18);
    CHECK(steps.max_below_low() == 8);
    CHECK(steps.first_above(6) == 4.0F);
    CHECK(steps.first_above(10) == 4.0F);
    CHECK(steps.first_above(11) == 50.0F);
    CHECK(steps.first_above(17) == 50.0F); // both steps there count at once
    CHECK_FALSE(steps.first_above(18).has_value());
    steps.start(4.0F, 100.0F);
    CHECK(steps.at_high() == 0);
    CHECK_FALSE(steps.first_above(0).has_value());
}

TEST_CASE("a later fall does not undo that the limit was passed") {
    StepFunction steps;
    steps.start(1.0F, 2.0F);
    steps.add(1.5F, 3);
    steps.add(1.50001F, -3);
    steps.add(1.25F, 1);
    CHECK(steps.first_above(3) == 1.5F);
    CHECK_FALSE(steps.first_above(4).has_value());
}

TEST_CASE("of many random steps the first above the limit is found as by sorting them") {
    Numbers numbers(3);
    for (int run = 0; run < 300; ++run) {
        const auto low = static_cast<float>(numbers.between(0.0, 10.0));
        const float high = low + static_cast<float>(numbers.between(0.0, run % 2 == 0 ? 1.0 : 1e5));
        StepFunction steps;
        steps.start(low, high);
        std::map<float, int> sorted;
        int below = 0;
        for (int k = 0; k < 400; ++k) {
            const auto place = static_cast<float>(numbers.between(0.0, 1.0)) * high;
            const int change = static_cast<int>(numbers.next() >> 9U) % 6 - 2;
            if (place < high) {
                steps.add(place, change);
                place < low ? below += change : sorted[place] += change;
            }
        }
        CHECK(steps.at_low() == below);
        const int limit = below + static_cast<int>(numbers.next() >> 9U) % 200;
        std::optional<float> expected;
        int count = below;
        for (const auto& [place, change] : sorted) {
            count += change;
            if (count > limit) {
                expected = place;
                break;
            }
        }
        REQUIRE(steps.first_above(limit) == expected);
    }
}
