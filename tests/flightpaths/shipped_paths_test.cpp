// The figures of the eight shipped paths against those they were designed to.

#include "flightpaths/fly_script.h"
#include "flightpaths/recorded_track.h"
#include "sim/base/axes.h"
#include "sim/base/hash.h"
#include "sim/base/units.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>

#include "scratch.h"

using namespace octant;
using namespace octant::flightpaths;
using octant::tests::shipped;

namespace {

const std::array<std::string, 8> names{
    "f15-straight",
    "f15-jinking",
    "f15-pop-up",
    "f15-turn",
    "500md-straight",
    "500md-jinking",
    "500md-pop-up",
    "500md-turn"};

FlownPath flown(const std::string& name) {
    const PathScript script = read_path_script(shipped(name));
    const auto limits = sim::limits_of(script.aircraft);
    REQUIRE(limits);
    FlownPath path = fly(script, *limits, false);
    CHECK(path.notes.empty());
    CHECK(path.trajectory.samples().size() == static_cast<std::size_t>(script.samples));
    return path;
}

struct Range {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();

    void take(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

/// Angle between two attitudes.
double turn_between_rad(const sim::AircraftState& a, const sim::AircraftState& b) {
    const double dot = std::abs(glm::dot(a.body_to_world, b.body_to_world));
    return 2.0 * std::acos(std::min(1.0, dot));
}

double track_deg(const sim::AircraftState& state) {
    return deg_from_rad(std::atan2(state.velocity_mps.x, state.velocity_mps.y));
}

double climb_deg(const sim::AircraftState& state) {
    return deg_from_rad(std::asin(state.velocity_mps.z / glm::length(state.velocity_mps)));
}

struct Figures {
    Range load_factor, height_m, speed_mps, bank_deg, east_m, climb_deg;
    double length_m = 0.0;
    double nearest_m = std::numeric_limits<double>::infinity(); ///< to the site, on the ground
    double most_turn_degps = 0.0;                               ///< of the body
    double heading_change_deg = 0.0;                            ///< clockwise, whole path
};

Figures figures_of(const sim::Trajectory& path) {
    Figures f;
    const auto samples = path.samples();
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const sim::AircraftState& now = samples[i];
        f.load_factor.take(now.load_factor);
        f.height_m.take(now.position_m.z);
        f.speed_mps.take(glm::length(now.velocity_mps));
        f.bank_deg.take(deg_from_rad(euler_from_body_to_world(now.body_to_world).roll_rad));
        f.east_m.take(now.position_m.x);
        f.climb_deg.take(climb_deg(now));
        f.nearest_m = std::min(f.nearest_m, std::hypot(now.position_m.x, now.position_m.y));
        if (i > 0) {
            const sim::AircraftState& before = samples[i - 1];
            const double step_s = now.time_s - before.time_s;
            f.length_m += glm::length(now.position_m - before.position_m);
            f.most_turn_degps =
                std::max(f.most_turn_degps, deg_from_rad(turn_between_rad(before, now)) / step_s);
            f.heading_change_deg +=
                deg_from_rad(wrapped_to_pi(rad_from_deg(track_deg(now) - track_deg(before))));
        }
    }
    return f;
}

Figures figures_of(const std::string& name) {
    return figures_of(flown(name).trajectory);
}

double begin_of(const FlownPath& path, const std::string& label) {
    for (const LegBegin& leg : path.legs) {
        if (leg.label == label) {
            return leg.time_s;
        }
    }
    FAIL("no leg " + label);
    return 0.0;
}

Approx within_tenth(double figure) {
    return Approx(figure).epsilon(0.1);
}

std::filesystem::path reference(const std::string& name) {
    const char* set = std::getenv("OCTANT_SHARED_DATA");
    const std::filesystem::path data =
        set != nullptr ? std::filesystem::path(set)
                       : std::filesystem::path(OCTANT_SOURCE_DIR) / ".." / "shared" / "data";
    return data / "paths" / (name + ".csv");
}

} // namespace

TEST_CASE("straight paths go past the site at their height, range and speed") {
    const Figures f15 = figures_of("f15-straight");
    CHECK(f15.nearest_m == Approx(600).epsilon(1e-6));
    CHECK(f15.height_m.most == Approx(150));
    CHECK(f15.length_m == Approx(9987.5));
    CHECK(f15.load_factor.most == Approx(1.0));
    CHECK(f15.most_turn_degps < 0.01);
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
    CHECK(f.most_turn_degps == within_tenth(190));
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
    CHECK(f.most_turn_degps == within_tenth(38));
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
    CHECK(f.most_turn_degps == within_tenth(123));
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
    CHECK(
        deg_from_rad(
            euler_from_body_to_world(path.trajectory.samples().back().body_to_world).roll_rad) ==
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
    const double rate_degps =
        track_deg(path.trajectory.state_at(10)) - track_deg(path.trajectory.state_at(11));
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
    const double rate_degps =
        track_deg(path.trajectory.state_at(10)) - track_deg(path.trajectory.state_at(11));
    CHECK(rate_degps == Approx(14).epsilon(0.01));
    CHECK(40 / rad_from_deg(rate_degps) == Approx(163).epsilon(0.01));
    CHECK(f.height_m.least == Approx(40).margin(0.5));
}

TEST_CASE("attitude, velocity and load factor never jump") {
    for (const std::string& name : names) {
        INFO(name);
        const FlownPath path = flown(name);
        const auto limits = *sim::limits_of(name.substr(0, name.find('-')));
        const auto samples = path.trajectory.samples();
        for (std::size_t i = 1; i < samples.size(); ++i) {
            const sim::AircraftState& a = samples[i - 1];
            const sim::AircraftState& b = samples[i];
            const double step_s = b.time_s - a.time_s;
            const double pull_mps2 =
                gravity_mps2 * (1.0 + std::max(std::abs(a.load_factor), std::abs(b.load_factor)));
            const double path_radps = pull_mps2 / glm::length(b.velocity_mps);
            const double attack_radps = rad_from_deg(1.2) * limits.load_factor_rate_gps;
            CHECK(
                turn_between_rad(a, b) <=
                (limits.roll_rate_radps + path_radps + attack_radps) * step_s);
            CHECK(
                std::abs(b.load_factor - a.load_factor) <=
                limits.load_factor_rate_gps * step_s + 1e-9);
            CHECK(
                glm::length(b.velocity_mps - a.velocity_mps) <=
                (pull_mps2 + limits.acceleration_mps2) * step_s);
            CHECK(glm::dot(a.body_to_world, b.body_to_world) > 0.0);
            CHECK(
                glm::length(
                    b.position_m - a.position_m -
                    0.5 * step_s * (a.velocity_mps + b.velocity_mps)) < 0.02);
        }
    }
}

TEST_CASE("the nose points along the path, raised by the angle of attack") {
    for (const std::string& name : names) {
        const PathScript script = read_path_script(shipped(name));
        const FlownPath path = flown(name);
        for (const auto& state : path.trajectory.samples()) {
            const glm::dvec3 along = glm::inverse(state.body_to_world) *
                                     (state.velocity_mps / glm::length(state.velocity_mps));
            CHECK(along.y == Approx(0).margin(1e-9));
            CHECK(
                std::atan2(along.z, along.x) ==
                Approx(script.angle_of_attack_rad_per_g * state.load_factor).margin(1e-9));
        }
    }
}

TEST_CASE("the same path is the same to the last bit in every build") {
    const auto hash_of = [](const std::string& name) {
        Hash hash;
        const FlownPath path = flown(name);
        for (const auto& state : path.trajectory.samples()) {
            const std::array<double, 11> values{
                state.position_m.x,
                state.position_m.y,
                state.position_m.z,
                state.velocity_mps.x,
                state.velocity_mps.y,
                state.velocity_mps.z,
                state.body_to_world.w,
                state.body_to_world.x,
                state.body_to_world.y,
                state.body_to_world.z,
                state.load_factor};
            hash.add(std::as_bytes(std::span(values)));
        }
        return hash.value();
    };
    // Made with glibc 2.36 on x86-64, debug and optimised.
    CHECK(hash_of("f15-pop-up") == 0xa38a50666efe1392ULL);
    CHECK(hash_of("500md-jinking") == 0xf76b23ea0f35e11dULL);
}

TEST_CASE("the shipped paths stay near trajectories integrated by other hands") {
    struct Case {
        const char* ours;
        const char* theirs;
        double furthest_m; ///< allowed over the whole path
    };

    for (const Case& c :
         {Case{"f15-straight", "f15_straight", 0.01},
          Case{"f15-turn", "f15_turn", 120},
          Case{"f15-pop-up", "f15_popup", 120},
          Case{"500md-straight", "md500_straight", 0.01},
          Case{"500md-turn", "md500_turn", 20},
          Case{"500md-pop-up", "md500_popup", 120}}) {
        if (!std::filesystem::exists(reference(c.theirs))) {
            std::cout << "SKIPPED: no reference trajectories at " << reference(c.theirs) << "\n";
            return;
        }
        const RecordedTrack theirs = read_recorded_track(reference(c.theirs));
        const FlownPath ours = flown(c.ours);
        double furthest_m = 0.0;
        for (const auto& state : theirs.trajectory.samples()) {
            furthest_m = std::max(
                furthest_m,
                glm::length(ours.trajectory.state_at(state.time_s).position_m - state.position_m));
        }
        INFO(c.ours << " " << furthest_m << " m");
        CHECK(furthest_m <= c.furthest_m);
    }
}
