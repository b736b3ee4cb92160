#include "ui/formation.h"

#include "sim/base/axes.h"

#include <cmath>

namespace octant::ui {

namespace {

constexpr double back_m = 15.0;
constexpr double aside_m = 17.0;

} // namespace

sim::AircraftState wingman_of(const sim::AircraftState& leader, int number) {
    const double rank = (number + 1) / 2;
    const double side = number % 2 == 1 ? 1.0 : -1.0;
    const double heading_rad = euler_from_body_to_world(leader.body_to_world).heading_rad;
    const glm::dvec3 ahead = direction_from_heading(heading_rad);
    const glm::dvec3 right(ahead.y, -ahead.x, 0.0);
    sim::AircraftState state = leader;
    state.position_m += rank * (side * aside_m * right - back_m * ahead);
    return state;
}

double formation_radius_m(int aircraft) {
    const double last_rank = aircraft / 2; // NOLINT(bugprone-integer-division): whole ranks
    return last_rank * std::hypot(back_m, aside_m);
}

} // namespace octant::ui
