#include "flightpaths/path_script.h"
#include "sim/base/error.h"
#include "sim/base/units.h"

#include <catch2/catch.hpp>

#include "scratch.h"

using namespace octant;
using namespace octant::flightpaths;
using octant::tests::replaced;
using octant::tests::written;

namespace {

const std::string good = R"(aircraft = "f15"
title = "Test"
rate_hz = 20
samples = 100
min_clearance_m = 50

[start]
north_m = -1000
east_m = 200
height_ft = 1000
heading_deg = 90
speed_kt = 400

[[leg]]
fly = "turn"
side = "left"
bank_deg = 30
heading_change_deg = 45
label = "first"

[[leg]]
fly = "straight"
duration_s = 5
)";

/// The message for a file with this text, without its path.
std::string fault_of(const std::string& text) {
    const auto file = written("fault.toml", text);
    try {
        read_path_script(file);
    } catch (const Error& error) {
        const std::string what = error.what();
        REQUIRE(what.find(file.string() + ":") == 0);
        return what.substr(file.string().size() + 1);
    }
    return "no error";
}

std::string fault_with(std::string_view from, std::string_view to) { return fault_of(replaced(good, from, to)); }

} // namespace

TEST_CASE("a path file is read in its units") {
    const PathScript script = read_path_script(written("good.toml", good));
    CHECK(script.aircraft == "f15");
    CHECK(script.samples == 100);
    CHECK(script.height_m == Approx(304.8));
    CHECK(script.speed_mps == Approx(205.78).epsilon(1e-4));
    CHECK(script.heading_rad == Approx(pi / 2));
    CHECK(script.start_line == 7);
    REQUIRE(script.legs.size() == 2);
    CHECK(script.legs[0].line == 14);
    CHECK(script.legs[0].kind == LegKind::Turn);
    CHECK(script.legs[0].to_the_left);
    CHECK(script.legs[0].bank_rad == Approx(rad_from_deg(30)));
    CHECK(script.legs[0].label == "first");
    CHECK(script.legs[1].duration_s == Approx(5));
}

TEST_CASE("a file that is no path file is refused") {
    CHECK_THROWS_WITH(read_path_script("/nowhere/a.toml"), "/nowhere/a.toml: expected a file, found none");
    CHECK(fault_of("") == "1: expected a flight path, got an empty file");
    CHECK(fault_of(" \n\t\n") == "1: expected a flight path, got an empty file");
    CHECK(fault_of(std::string("a = \"\0\"", 8)) == " expected text, got binary data");
    CHECK(fault_of("\x89PNG\r\n") != "no error");
    CHECK(fault_of("t_s,north_m\n0,1\n").substr(0, 31) == "1: expected TOML, got a fault: ");
    CHECK(fault_of(good.substr(0, good.find("left") + 2)).substr(0, 32) == "16: expected TOML, got a fault: ");
}

TEST_CASE("what is missing is named") {
    CHECK(fault_with("aircraft = \"f15\"\n", "") == "1: expected aircraft, got no such key");
    CHECK(fault_with("samples = 100\n", "") == "1: expected samples, got no such key");
    CHECK(fault_with("east_m = 200\n", "") == "7: expected east_m or east_ft, got no such key");
    CHECK(fault_with("duration_s = 5\n", "") == "21: expected duration_s, got no such key");
    CHECK(fault_with("side = \"left\"\n", "") == "14: expected side, got no such key");
    CHECK(fault_with("fly = \"turn\"\n", "") == "14: expected fly, got no such key");
    CHECK(fault_with("bank_deg = 30\n", "") == "14: expected either bank_deg or load_factor_g, got neither");
    CHECK(fault_of(good.substr(0, good.find("[[leg]]"))) == "1: expected [[leg]], got no such key");
    CHECK(fault_of("leg = []\n" + good.substr(0, good.find("[[leg]]"))) ==
          "1: expected tables [[leg]], got an empty array");
}

TEST_CASE("a value of another kind is refused") {
    CHECK(fault_with("samples = 100", "samples = 100.5") == "4: expected samples to be a whole number, got a number");
    CHECK(fault_with("samples = 100", "samples = \"100\"") == "4: expected samples to be a whole number, got a text");
    CHECK(fault_with("bank_deg = 30", "bank_deg = true") == "17: expected bank_deg to be a number, got true or false");
    CHECK(fault_with("title = \"Test\"", "title = 7") == "2: expected title to be a text, got a whole number");
    CHECK(fault_with("title = \"Test\"", "title = \"\"") ==
          "2: expected title to be a text of 1 to 200 plain characters, got \"\"");
    CHECK(fault_with("title = \"Test\"", "title = \"a\\nb\"") ==
          "2: expected title to be a text of 1 to 200 plain characters, got \"a?b\"");
    CHECK(fault_of("start = 3\n" + replaced(good, "[start]", "[begin]")) ==
          "1: expected a table [start], got a whole number");
    CHECK(fault_of("leg = [1, 2]\n" + good.substr(0, good.find("[[leg]]"))) ==
          "1: expected tables [[leg]], got an array of something else");
}

TEST_CASE("a number out of its bounds is refused in the unit it was given in") {
    CHECK(fault_with("rate_hz = 20", "rate_hz = -20") == "3: expected rate_hz from 1 to 120, got -20");
    CHECK(fault_with("min_clearance_m = 50", "min_clearance_m = 0") ==
          "5: expected min_clearance_m from 1 to 40000, got 0");
    CHECK(fault_with("min_clearance_m = 50", "min_clearance_ft = 3") ==
          "5: expected min_clearance_ft from 3.28084 to 131234, got 3");
    CHECK(fault_with("min_clearance_m = 50", "min_clearance_m = 1") == "no error");
    CHECK(fault_with("rate_hz = 20", "rate_hz = 7") == "3: expected a rate_hz that divides 120, got 7");
    CHECK(fault_with("samples = 100", "samples = 1") == "4: expected samples from 2 to 200000, got 1");
    CHECK(fault_with("samples = 100", "samples = 9000000000000000000") ==
          "4: expected samples from 2 to 200000, got 9000000000000000000");
    CHECK(fault_with("samples = 100", "samples = 200000") == "4: expected samples for at most 7200 s, got 10000 s");
    CHECK(fault_with("speed_kt = 400", "speed_kt = nan") == "12: expected speed_kt to be finite, got nan");
    CHECK(fault_with("speed_kt = 400", "speed_kt = -inf") == "12: expected speed_kt to be finite, got -inf");
    CHECK(fault_with("speed_kt = 400", "speed_kt = 0") == "12: expected speed_kt from 1.94384 to 2915.77, got 0");
    CHECK(fault_with("bank_deg = 30", "bank_deg = 86") == "17: expected bank_deg from 1 to 85, got 86");
    CHECK(
        fault_with("duration_s = 5", "duration_s = 1e300") == "23: expected duration_s from 0.05 to 7200, got 1e+300");
}

TEST_CASE("unknown, doubled and contradicting keys are refused") {
    CHECK(fault_with("label = \"first\"", "colour = \"red\"") == "19: expected a key that belongs here, got colour");
    CHECK(fault_with("title = \"Test\"", "title = \"Test\"\nbank_deg = 3") ==
          "3: expected a key that belongs here, got bank_deg");
    CHECK(fault_with("speed_kt = 400", "speed_kt = 400\nspeed_mps = 200") ==
          "12: expected one of speed_mps and speed_kt, got both");
    CHECK(fault_with("title = \"Test\"", "title = \"Test\"\ntitle = \"Test\"").substr(0, 31) ==
          "3: expected TOML, got a fault: ");
    CHECK(fault_with("bank_deg = 30", "bank_deg = 30\nload_factor_g = 2") ==
          "14: expected either bank_deg or load_factor_g, got both");
    CHECK(fault_with("fly = \"turn\"", "fly = \"spin\"") ==
          "15: expected fly to be one of straight, hold, climb, dive, turn, jink, pull, push, got "
          "\"spin\"");
    CHECK(
        fault_with("side = \"left\"", "side = \"port\"") == "16: expected side to be one of left, right, got \"port\"");
    CHECK(fault_with("duration_s = 5", "duration_s = 5\nto_speed_mps = 100") ==
          "21: expected acceleration_mps2 beside to_speed_mps, got none");
    CHECK(fault_with("fly = \"straight\"", "fly = \"jink\"\nlateral_g = 1\nperiod_s = 5\nvertical_g = 1") ==
          "21: expected vertical_g and vertical_period_s together, got one of them");
    CHECK(fault_with("fly = \"straight\"\nduration_s = 5", "fly = \"pull\"\nload_factor_g = 0.5\nto_climb_deg = 3") ==
          "23: expected load_factor_g from 1.01 to 20, got 0.5");
    CHECK(fault_with("fly = \"straight\"\nduration_s = 5", "fly = \"climb\"\nclimb_deg = 5") ==
          "21: expected either duration_s or to_height_m (or _ft), got neither");
}

TEST_CASE("every cut of a good file is read or refused, never worse") {
    for (std::size_t length = 0; length < good.size(); ++length) {
        const std::string fault = fault_of(good.substr(0, length));
        CHECK_FALSE(fault.empty());
        CHECK(fault.find('\n') == std::string::npos);
    }
}
