#include "visuals/refine/progressive_tree.h"
#include "visuals/refine/selective_refiner.h"

#include <catch2/catch.hpp>

#include <iterator>
#include <random>
#include <set>

using namespace octant::visuals::refine;

TEST_CASE("the member at or before a number is found over any distance") {
    ActiveLeafSet starts;
    starts.assign(100);
    starts.add(0);
    starts.add(63);
    starts.add(64);
    CHECK(starts.last_up_to(0) == 0);
    CHECK(starts.last_up_to(62) == 0);
    CHECK(starts.last_up_to(63) == 63);
    CHECK(starts.last_up_to(99) == 64);
    starts.remove(64);
    CHECK(starts.last_up_to(99) == 63);
    CHECK(starts.has(63));
    CHECK_FALSE(starts.has(64));
}

TEST_CASE("a set of starts is one whatever its bound") {
    for (const std::uint32_t bound : {1U, 64U, 65U, 4096U, 4097U, 300000U}) {
        ActiveLeafSet starts;
        starts.assign(bound);
        std::set<std::uint32_t> expected{0};
        starts.add(0);
        std::mt19937 numbers(bound);
        for (int i = 0; i < 2000; ++i) {
            const auto number = static_cast<std::uint32_t>(numbers() % bound);
            if (number > 0 && starts.has(number)) {
                starts.remove(number);
                expected.erase(number);
            } else {
                starts.add(number);
                expected.insert(number);
            }
            const auto at = static_cast<std::uint32_t>(numbers() % bound);
            CHECK(starts.last_up_to(at) == *std::prev(expected.upper_bound(at)));
        }
    }
}

TEST_CASE("three bytes hold a number below 2^24 and leave its neighbours alone") {
    Uint24Array numbers;
    numbers.assign(3);
    numbers.set(1, 0xabcdefU);
    CHECK(numbers[0] == 0);
    CHECK(numbers[1] == 0xabcdefU);
    CHECK(numbers[2] == 0);
    numbers.set(2, 0xffffffU);
    numbers.set(0, 1);
    CHECK(numbers[0] == 1);
    CHECK(numbers[1] == 0xabcdefU);
    CHECK(numbers[2] == 0xffffffU);
}
