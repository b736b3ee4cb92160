// The figures of the eight shipped paths against those they were designed to.

#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "tests/flightpaths/shipped_figures.h"

#include <catch2/catch.hpp>

using namespace octant;
using namespace octant::flightpaths;
using namespace octant::tests;

namespace {

Approx within_tenth(double figure) { return Approx(figure).epsilon(0.1); }

} // namespace

TEST_CASE("straight paths go past the site at their height, range and speed") {
    const Figures f15 = figures_of("f15-straight");
    CHECK(f15.nearest_m == Approx(600).epsilon(1e-6));
    CHECK(f15.height_m.most == Approx(150));
    CHECK(f15.length_m == Approx(9987.5));
    CHECK(f15.load_factor.most == Approx(1.0));
    CHECK(f15.max_turn_degps < 0.01);
    const Figures md500 = figures_of("500md-straight");
    CHECK(md500.nearest_m == Approx(250).epsilon(1e-6));
    CHECK(md500.height_m.least == Approx(30));
    CHECK(md500.length_m == Approx(2397));
}

TEST_CASE("the F-15 weaves at 3 g with its bank, roll rate and amplitude") {
    const Figures f = figures_of("f15-jinking");
    CHECK(f.load_factor.least == within_tenth(0.71));
    CHECK(f.load_factor.most == Approx(3.27).epsilon(0.02));
    CHECK(f.bank_deg.most == within_tenth(77));
    CHECK(f.bank_deg.least == within_tenth(-77));
    CHECK(f.max_turn_degps == within_tenth(190));
    CHECK(f.height_m.least == within_tenth(197));
    CHECK(f.height_m.most == within_tenth(207));
    CHECK(f.length_m == Approx(8740).epsilon(0.01));
    CHECK((f.east_m.most - f.east_m.least) / 2 == within_tenth(48));
}

TEST_CASE("the 500MD weaves at 0.7 g with its bank, roll rate and amplitude") {
    const Figures f = figures_of("500md-jinking");
    CHECK(f.load_factor.least == within_tenth(0.74));
    CHECK(f.load_factor.most == Approx(1.43).epsilon(0.02));
    CHECK(f.bank_deg.most == within_tenth(44));
    CHECK(f.bank_deg.least == within_tenth(-44));
    CHECK(f.max_turn_degps == within_tenth(38));
    CHECK((f.east_m.most - f.east_m.least) / 2 == within_tenth(14));
    // 0.25 g every 6.5 s moves it 2.6 m up and down, well inside the 26 to 43 m of the design.
    CHECK((f.height_m.most - f.height_m.least) / 2 == within_tenth(2.62));
    CHECK(f.height_m.least > 26);
    CHECK(f.height_m.most < 43);
}

TEST_CASE("the F-15 pops up, pulls down, tracks and pulls out where it should") {
    const FlownPath path = flown("f15-pop-up");
    const Figures f = figures_of(path.trajectory);
    CHECK(f.load_factor.most == Approx(5.0).epsilon(0.02));
    CHECK(f.load_factor.least == Approx(0.6).margin(0.2));
    CHECK(f.speed_mps.least == Approx(227).epsilon(0.02));
    CHECK(f.speed_mps.most == Approx(250).epsilon(0.001));
    CHECK(f.height_m.most == Approx(1104).epsilon(0.03));
    CHECK(f.height_m.least == Approx(90));
    CHECK(f.max_turn_degps == within_tenth(123));
    CHECK(f.bank_deg.most == Approx(120).epsilon(0.02));
    CHECK(f.climb_deg.most == Approx(30).margin(1.5));
    CHECK(f.climb_deg.least == Approx(-20).margin(1.5));
    CHECK(path.trajectory.state_at(11.5).position_m.z == within_tenth(405));
    const double pull_down_s = begin_of(path, "pull-down");
    const double tracking_s = begin_of(path, "tracking");
    const double pull_out_s = begin_of(path, "pull-out");
    CHECK(pull_down_s == Approx(14.1).epsilon(0.02));
    CHECK(tracking_s == Approx(22.5).epsilon(0.03));
    CHECK(path.trajectory.state_at(pull_down_s).position_m.z == Approx(728).epsilon(0.005));
    CHECK(path.trajectory.state_at(tracking_s).position_m.z == Approx(987).epsilon(0.03));
    CHECK(path.trajectory.state_at(pull_out_s).position_m.z == Approx(488).epsilon(0.03));
    const auto at = [&](double time_s) { return track_deg(path.trajectory.state_at(time_s)); };
    CHECK(at(pull_out_s) - at(pull_down_s) == within_tenth(59));
    Range out;
    for (double time_s = pull_out_s; time_s < begin_of(path, "egress"); time_s += 0.05) {
        out.take(path.trajectory.state_at(time_s).position_m.z);
    }
    CHECK(out.least == Approx(373).epsilon(0.03));
    CHECK(deg_from_rad(euler_from_body_to_world(path.trajectory.samples().back().body_to_world).roll_rad) ==
          Approx(70).epsilon(0.02));
}

TEST_CASE("the 500MD pops up within its energy, dives and turns away") {
    const FlownPath path = flown("500md-pop-up");
    const Figures f = figures_of(path.trajectory);
    CHECK(f.load_factor.most == Approx(1.6).epsilon(0.01));
    CHECK(f.load_factor.least == Approx(0.35).epsilon(0.01));
    CHECK(f.climb_deg.most == Approx(18).margin(0.5));
    CHECK(f.climb_deg.least == Approx(-12).margin(0.5));
    CHECK(path.trajectory.state_at(12.8).position_m.z == within_tenth(95));
    CHECK(f.height_m.most == Approx(114).epsilon(0.02));
    CHECK(f.speed_mps.least == Approx(44).epsilon(0.03));
    CHECK(path.trajectory.state_at(25.0).position_m.z == Approx(48).epsilon(0.03));
    CHECK(f.bank_deg.least == Approx(-35).epsilon(0.01));
    CHECK(f.heading_change_deg == Approx(-90).margin(1.5));
}

TEST_CASE("the F-15 turns at 4 g") {
    const FlownPath path = flown("f15-turn");
    const Figures f = figures_of(path.trajectory);
    CHECK(f.load_factor.most == Approx(4.0).epsilon(0.01));
    CHECK(f.bank_deg.least == Approx(-75.5).epsilon(0.005));
    CHECK(f.heading_change_deg == Approx(-175).margin(2));
    CHECK(f.speed_mps.least == Approx(229.3).epsilon(0.005));
    CHECK(f.length_m == Approx(6710).epsilon(0.005));
    CHECK(begin_of(path, "turn") == Approx(3.0));
    const double rate_degps = track_deg(path.trajectory.state_at(10)) - track_deg(path.trajectory.state_at(11));
    CHECK(rate_degps > 9.1);
    CHECK(rate_degps < 9.9);
    CHECK(232.9 / rad_from_deg(rate_degps) == within_tenth(1400));
    CHECK(f.height_m.least == Approx(300).margin(5));
    CHECK(f.height_m.most == Approx(300).margin(5));
}

TEST_CASE("the 500MD turns at 45 degrees of bank") {
    const FlownPath path = flown("500md-turn");
    const Figures f = figures_of(path.trajectory);
    CHECK(f.load_factor.most == Approx(1.41).epsilon(0.01));
    CHECK(f.bank_deg.least == Approx(-45).epsilon(0.005));
    CHECK(f.heading_change_deg == Approx(-336).margin(2));
    const double rate_degps = track_deg(path.trajectory.state_at(10)) - track_deg(path.trajectory.state_at(11));
    CHECK(rate_degps == Approx(14).epsilon(0.01));
    CHECK(40 / rad_from_deg(rate_degps) == Approx(163).epsilon(0.01));
    CHECK(f.height_m.least == Approx(40).margin(0.5));
}
