#include "ui/command_line/command_line.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using octant::ui::command_line::did_you_mean;
using octant::ui::command_line::nearest_spelling;

TEST_CASE("a slip of the fingers finds the word that was meant, another word none") {
    const std::vector<std::string> known{"--frames", "--frame-per-sample", "--seconds", "--size", "--start", "--rate"};
    CHECK(nearest_spelling("--frams", known) == "--frames");
    CHECK(nearest_spelling("--frmaes", known) == "--frames");
    CHECK(nearest_spelling("-frames", known) == "--frames");
    CHECK(nearest_spelling("--sec", known) == "--seconds");
    CHECK(nearest_spelling("--starts", known) == "--start");
    CHECK_FALSE(nearest_spelling("--video", known));
    CHECK_FALSE(nearest_spelling("--", known));
    CHECK_FALSE(nearest_spelling("", known));
    CHECK_FALSE(nearest_spelling(std::string(100'000, 'a'), known));
    CHECK(did_you_mean("--rat", known) == "; perhaps --rate is meant");
    CHECK(did_you_mean("--video", known).empty());
}

TEST_CASE("between two words that are equally near none is chosen") {
    const std::vector<std::string> known{"--near", "--fear"};
    CHECK_FALSE(nearest_spelling("--tear", known));
    CHECK(nearest_spelling("--fear", known) == "--fear");
}
