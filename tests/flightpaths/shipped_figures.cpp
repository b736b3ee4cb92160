#include "tests/flightpaths/shipped_figures.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

#include "scratch.h"

namespace octant::tests {

using namespace octant::flightpaths;

namespace {

double climb_deg(const sim::AircraftState& state) {
    return deg_from_rad(std::asin(state.velocity_mps.z / glm::length(state.velocity_mps)));
}

} // namespace

FlownPath flown(const std::string& name) {
    const PathScript script = read_path_script(shipped(name));
    FlownPath path = fly(script, sim::aircraft_kind(script.aircraft), false);
    CHECK(path.notes.empty());
    CHECK(path.trajectory.samples().size() == static_cast<std::size_t>(script.samples));
    return path;
}

void Range::take(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
}

double turn_between_rad(const sim::AircraftState& a, const sim::AircraftState& b) {
    const double dot = std::abs(glm::dot(a.body_to_world, b.body_to_world));
    return 2.0 * std::acos(std::min(1.0, dot));
}

double track_deg(const sim::AircraftState& state) {
    return deg_from_rad(std::atan2(state.velocity_mps.x, state.velocity_mps.y));
}

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
            f.max_turn_degps = std::max(f.max_turn_degps, deg_from_rad(turn_between_rad(before, now)) / step_s);
            f.heading_change_deg += deg_from_rad(wrapped_to_pi(rad_from_deg(track_deg(now) - track_deg(before))));
        }
    }
    return f;
}

Figures figures_of(const std::string& name) { return figures_of(flown(name).trajectory); }

double begin_of(const FlownPath& path, const std::string& label) {
    for (const LegStart& leg : path.legs) {
        if (leg.label == label) { return leg.time_s; }
    }
    FAIL("no leg " + label);
    return 0.0;
}

} // namespace octant::tests
