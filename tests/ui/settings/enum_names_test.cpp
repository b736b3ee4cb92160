#include "ui/settings/settings_text.h"

#include <catch2/catch.hpp>

#include <vector>

namespace octant::ui::settings {

namespace {

enum class Shuffled { One, Two };
enum class OneForgotten { One, Two, Three };
enum class OneTwice { One, Two };
enum class GapInTheMiddle { One, Two, Three };
enum class Unnamed { One };

} // namespace

template <>
inline constexpr std::array enum_names<Shuffled>{EnumName{Shuffled::Two, "two"}, EnumName{Shuffled::One, "one"}};

template <>
inline constexpr std::array enum_names<OneForgotten>{
    EnumName{OneForgotten::One, "one"}, EnumName{OneForgotten::Two, "two"}};

template <>
inline constexpr std::array enum_names<OneTwice>{EnumName{OneTwice::One, "one"}, EnumName{OneTwice::One, "two"}};

template <>
inline constexpr std::array enum_names<GapInTheMiddle>{
    EnumName{GapInTheMiddle::One, "one"}, EnumName{GapInTheMiddle::Three, "three"}};

} // namespace octant::ui::settings

using namespace octant::ui::settings;

TEST_CASE("names belong to their values, in whichever order they are listed") {
    STATIC_REQUIRE(names_each_value_once<Shuffled>());
    CHECK(name_of(Shuffled::One) == "one");
    CHECK(name_of(Shuffled::Two) == "two");
    const auto names = names_of<Shuffled>();
    CHECK(std::vector(names.begin(), names.end()) == std::vector<std::string_view>{"one", "two"});
}

TEST_CASE("an enumerator that has no name or shares its row is found by the compiler") {
    STATIC_REQUIRE_FALSE(names_each_value_once<OneForgotten>());
    STATIC_REQUIRE_FALSE(names_each_value_once<OneTwice>());
    STATIC_REQUIRE_FALSE(names_each_value_once<GapInTheMiddle>());
    STATIC_REQUIRE_FALSE(names_each_value_once<Unnamed>());
}
