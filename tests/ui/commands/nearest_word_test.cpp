#include "ui/commands/nearest_word.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using octant::ui::commands::nearest_word;
using octant::ui::commands::perhaps_meant;

TEST_CASE("a slip of the fingers finds the word that was meant, another word none") {
    const std::vector<std::string> known{
        "--frames", "--frame-per-sample", "--seconds", "--size", "--start", "--rate"};
    CHECK(nearest_word("--frams", known) == "--frames");
    CHECK(nearest_word("--frmaes", known) == "--frames");
    CHECK(nearest_word("-frames", known) == "--frames");
    CHECK(nearest_word("--sec", known) == "--seconds");
    CHECK(nearest_word("--starts", known) == "--start");
    CHECK_FALSE(nearest_word("--video", known));
    CHECK_FALSE(nearest_word("--", known));
    CHECK_FALSE(nearest_word("", known));
    CHECK_FALSE(nearest_word(std::string(100'000, 'a'), known));
    CHECK(perhaps_meant("--rat", known) == "; perhaps --rate is meant");
    CHECK(perhaps_meant("--video", known).empty());
}

TEST_CASE("between two words that are equally near none is chosen") {
    const std::vector<std::string> known{"--near", "--fear"};
    CHECK_FALSE(nearest_word("--tear", known));
    CHECK(nearest_word("--fear", known) == "--fear");
}
