// How the eight shipped paths move from sample to sample, the same in every build, and how near they are to
// trajectories made elsewhere.

#include "flightpaths/recorded_track.h"
#include "sim/base/hash.h"
#include "sim/base/units.h"
#include "tests/flightpaths/shipped_figures.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "scratch.h"

using namespace octant;
using namespace octant::flightpaths;
using namespace octant::tests;

namespace {

std::filesystem::path reference(const std::string& name) {
    const char* set = std::getenv("OCTANT_SHARED_DATA");
    const std::filesystem::path data = set != nullptr
                                           ? std::filesystem::path(set)
                                           : std::filesystem::path(OCTANT_SOURCE_DIR) / ".." / "shared" / "data";
    return data / "paths" / (name + ".csv");
}

} // namespace

TEST_CASE("attitude, velocity and load factor never jump") {
    for (const std::string& name : path_names) {
        INFO(name);
        const FlownPath path = flown(name);
        const sim::AircraftLimits& limits = sim::aircraft_kind(name.substr(0, name.find('-'))).limits;
        const auto samples = path.trajectory.samples();
        for (std::size_t i = 1; i < samples.size(); ++i) {
            const sim::AircraftState& a = samples[i - 1];
            const sim::AircraftState& b = samples[i];
            const double step_s = b.time_s - a.time_s;
            const double pull_mps2 = gravity_mps2 * (1.0 + std::max(std::abs(a.load_factor), std::abs(b.load_factor)));
            const double path_radps = pull_mps2 / glm::length(b.velocity_mps);
            const double attack_radps = rad_from_deg(1.2) * limits.load_factor_rate_gps;
            CHECK(turn_between_rad(a, b) <= (limits.roll_rate_radps + path_radps + attack_radps) * step_s);
            CHECK(std::abs(b.load_factor - a.load_factor) <= limits.load_factor_rate_gps * step_s + 1e-9);
            CHECK(glm::length(b.velocity_mps - a.velocity_mps) <= (pull_mps2 + limits.acceleration_mps2) * step_s);
            CHECK(glm::dot(a.body_to_world, b.body_to_world) > 0.0);
            CHECK(glm::length(b.position_m - a.position_m - 0.5 * step_s * (a.velocity_mps + b.velocity_mps)) < 0.02);
        }
    }
}

TEST_CASE("the nose points along the path, raised by the angle of attack") {
    for (const std::string& name : path_names) {
        const PathScript script = read_path_script(shipped(name));
        const FlownPath path = flown(name);
        for (const auto& state : path.trajectory.samples()) {
            const glm::dvec3 along =
                glm::inverse(state.body_to_world) * (state.velocity_mps / glm::length(state.velocity_mps));
            CHECK(along.y == Approx(0).margin(1e-9));
            CHECK(std::atan2(along.z, along.x) ==
                  Approx(script.angle_of_attack_rad_per_g * state.load_factor).margin(1e-9));
        }
    }
}

TEST_CASE("the same path is the same to the last bit in every build") {
    const auto hash_of = [](const std::string& name) {
        Hash hash;
        const FlownPath path = flown(name);
        for (const auto& state : path.trajectory.samples()) {
            const std::array<double, 11> values{state.position_m.x, state.position_m.y, state.position_m.z,
                state.velocity_mps.x, state.velocity_mps.y, state.velocity_mps.z, state.body_to_world.w,
                state.body_to_world.x, state.body_to_world.y, state.body_to_world.z, state.load_factor};
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

    for (const Case& c : {Case{"f15-straight", "f15_straight", 0.01}, Case{"f15-turn", "f15_turn", 120},
             Case{"f15-pop-up", "f15_popup", 120}, Case{"500md-straight", "md500_straight", 0.01},
             Case{"500md-turn", "md500_turn", 20}, Case{"500md-pop-up", "md500_popup", 120}}) {
        if (!std::filesystem::exists(reference(c.theirs))) {
            std::cout << "SKIPPED: no reference trajectories at " << reference(c.theirs) << "\n";
            return;
        }
        const RecordedTrack theirs = read_recorded_track(reference(c.theirs));
        const FlownPath ours = flown(c.ours);
        double furthest_m = 0.0;
        for (const auto& state : theirs.trajectory.samples()) {
            furthest_m =
                std::max(furthest_m, glm::length(ours.trajectory.state_at(state.time_s).position_m - state.position_m));
        }
        INFO(c.ours << " " << furthest_m << " m");
        CHECK(furthest_m <= c.furthest_m);
    }
}
