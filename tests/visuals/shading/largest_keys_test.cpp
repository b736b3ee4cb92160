#include "visuals/shading/largest_keys.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

using namespace octant::visuals::shading;

namespace {

std::vector<std::uint8_t> chosen(const std::vector<std::uint32_t>& keys, std::size_t count) {
    std::vector<std::uint8_t> result(keys.size(), 7);
    LargestKeySelector greatest;
    greatest.choose(keys, count, result);
    return result;
}

} // namespace

TEST_CASE("the greatest keys are chosen, of equal ones the first") {
    using Marks = std::vector<std::uint8_t>;
    CHECK(chosen({5, 9, 1, 9}, 1) == Marks{0, 1, 0, 0});
    CHECK(chosen({5, 9, 1, 9}, 3) == Marks{1, 1, 0, 1});
    CHECK(chosen({4, 4, 4}, 2) == Marks{1, 1, 0});
    CHECK(chosen({5, 9, 1}, 0) == Marks{0, 0, 0});
    CHECK(chosen({5, 9, 1}, 3) == Marks{1, 1, 1});
    CHECK(chosen({}, 0).empty());
}

TEST_CASE("keys sort by tier, then by rank") {
    CHECK(sort_key(1, 0.0F) > sort_key(0, 1e30F));
    CHECK(sort_key(0, 2.0F) > sort_key(0, 1.0F));
    CHECK(sort_key(3, 0.5F) > sort_key(3, 1e-30F));
}

TEST_CASE("counting finds what sorting finds") {
    std::mt19937 dice(3);
    LargestKeySelector greatest;
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<std::uint32_t> keys(dice() % 400 + 1);
        const std::uint32_t range = trial % 3 == 0 ? 10U : 0xffffffffU;
        for (std::uint32_t& key : keys) { key = static_cast<std::uint32_t>(dice() % range); }
        const std::size_t count = dice() % (keys.size() + 1);
        std::vector<std::uint32_t> sorted(keys.size());
        std::iota(sorted.begin(), sorted.end(), 0U);
        std::ranges::stable_sort(sorted, [&](std::uint32_t a, std::uint32_t b) { return keys[a] > keys[b]; });
        std::vector<std::uint8_t> expected(keys.size(), 0);
        for (std::size_t i = 0; i < count; ++i) { expected[sorted[i]] = 1; }
        std::vector<std::uint8_t> found(keys.size());
        greatest.choose(keys, count, found);
        CHECK(found == expected);
    }
}
