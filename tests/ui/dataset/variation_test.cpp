#include "sim/base/error.h"
#include "ui/dataset/variation.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

using namespace octant;
using namespace octant::ui::dataset;
using Catch::Contains;

namespace {

constexpr std::array<std::string_view, 2> fixed{"view", "frames"};

std::vector<VariedSetting> parsed(std::string_view text) { return parse_variation(text, fixed); }

/// The number that a setting of one value has in a sample.
double number_of(const VariedSetting& varied, std::uint64_t seed, std::uint64_t index) {
    return std::stod(words_of(varied, {seed, index}).front());
}

} // namespace

TEST_CASE("variation reads ranges, lists, several aircraft and places") {
    const auto varied = parsed(
        "sun-elevation=5:60,clouds=0:0.7,palette=temperate|arid,place=-2000,-1000:2000,1000,aircraft=f15|f15+500md,"
        "triangles=1000:3000,time=2026-06-21T04:00|2026-12-21T12:30");
    REQUIRE(varied.size() == 7);
    CHECK(varied[0].low == std::vector{5.0});
    CHECK(varied[0].high == std::vector{60.0});
    CHECK(varied[2].choices == std::vector<std::vector<std::string>>{{"temperate"}, {"arid"}});
    CHECK(varied[3].low == std::vector{-2000.0, -1000.0});
    CHECK(varied[3].high == std::vector{2000.0, 1000.0});
    CHECK(varied[4].choices == std::vector<std::vector<std::string>>{{"f15"}, {"f15", "500md"}});
    CHECK(varied[5].is_whole);
    CHECK(varied[6].choices.size() == 2);
}

TEST_CASE("variation that no setting takes is refused with one line") {
    const auto refused = [](std::string_view text, const std::string& expected) {
        INFO(text);
        CHECK_THROWS_WITH(parsed(text), Contains("--vary: ") && Contains(expected));
    };
    refused("sun-hight=5:60", "expected a setting of octant fly, got 'sun-hight'");
    refused("sun-elevation=60:5", "expected sun-elevation from a low end to a high one");
    refused("sun-elevation=5:95", "sun-elevation: expected");
    refused("sun-elevation=low:high", "expected sun-elevation as LOW:HIGH of numbers");
    refused("triangles=1000.5:3000", "whole numbers");
    refused("palette=temperate|green", "palette: expected");
    refused("aircraft=f15|f16", "aircraft: expected");
    refused("view=chase|tower", "expected a setting of the world");
    refused("clouds=0:1,clouds=0.5", "expected each setting once");
    refused("place=0,0:1", "expected place as LOW:HIGH of X,Y");
    refused("clouds", "expected SETTING=LOW:HIGH");
    refused("clouds=", "expected clouds=LOW:HIGH");
    refused("", "expected SETTING=LOW:HIGH");
}

TEST_CASE("a sample's values depend on the seed, the index and the setting only") {
    const auto one = parsed("sun-elevation=5:60,clouds=0:0.7");
    const auto other = parsed("visibility=3000:40000,clouds=0:0.7,sun-elevation=5:60");
    for (const std::uint64_t index : {0U, 1U, 17U, 4999U}) {
        CHECK(number_of(one[0], 3, index) == number_of(other[2], 3, index));
        CHECK(number_of(one[1], 3, index) == number_of(other[1], 3, index));
    }
    CHECK(number_of(one[0], 3, 17) != number_of(one[0], 4, 17));
    CHECK(number_of(one[0], 3, 17) != number_of(one[0], 3, 18));
    // Ranges of the same share of different settings do not go together.
    CHECK(number_of(one[0], 3, 17) / 55.0 != number_of(one[1], 3, 17) / 0.7);
}

TEST_CASE("values of many samples fill their range evenly, of neighbouring seeds too") {
    const auto varied = parsed("clouds=0:1,triangles=100:103,palette=temperate|arid");
    constexpr int count = 4000;
    for (const std::uint64_t seed : {0U, 1U, 2U, 1000003U}) {
        std::array<int, 10> tenths{};
        std::map<std::string, int> whole;
        std::map<std::string, int> listed;
        double products = 0.0; // of neighbours, about their mean
        double before = 0.5;
        for (std::uint64_t i = 0; i < count; ++i) {
            const double x = number_of(varied[0], seed, i);
            ++tenths.at(static_cast<std::size_t>(10.0 * x));
            products += (x - 0.5) * (before - 0.5);
            before = x;
            ++whole[words_of(varied[1], {seed, i}).front()];
            ++listed[words_of(varied[2], {seed, i}).front()];
        }
        CHECK(*std::ranges::min_element(tenths) > 320); // 400 expected, standard deviation 19
        CHECK(*std::ranges::max_element(tenths) < 480);
        CHECK(std::abs(products / count) < 5.0 / 12.0 / std::sqrt(double(count)));
        REQUIRE(whole.size() == 4);
        for (const auto& [text, times] : whole) { CHECK(std::abs(times - 1000) < 140); }
        CHECK(std::abs(listed["arid"] - 2000) < 160);
    }
}

TEST_CASE("a sample's settings are the base with the drawn values") {
    ui::settings::RunSettings base;
    base.air.clouds = 0.25;
    const auto varied = parsed("sun-elevation=5:60,aircraft=f15+500md");
    std::vector<std::pair<std::string, std::string>> values;
    const auto settings = settings_of(base, varied, {3, 17}, &values);
    CHECK(settings.air.clouds == 0.25);
    CHECK(settings.path.aircraft == std::vector<std::string>{"f15", "500md"});
    REQUIRE(values.size() == 2);
    CHECK(values[0].first == "sun-elevation");
    CHECK(std::stod(values[0].second) == settings.air.sun_elevation_deg);
    CHECK(values[1].second == "f15+500md");
}
