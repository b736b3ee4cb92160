#include "ui/world/formation.h"

#include "sim/base/axes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace octant::ui::world {

namespace planning = visuals::planning;

namespace {

constexpr int max_abreast = 9;

int aircraft_abreast(int aircraft) {
    return aircraft <= max_abreast ? aircraft
                                   : static_cast<int>(std::ceil(std::cbrt(static_cast<double>(aircraft)) - 1e-9));
}

} // namespace

Formation::Formation(int aircraft, double largest_radius_m)
    : abreast_(aircraft_abreast(aircraft)), lines_per_layer_(aircraft <= max_abreast ? 1 : abreast_),
      wingmen_per_side_(abreast_ / 2), lateral_spacing_m_(1.7 * largest_radius_m),
      trail_spacing_m_(0.5 * largest_radius_m) {}

sim::AircraftState Formation::wingman_state(const sim::AircraftState& leader, int number) const {
    const int place = number % abreast_;
    const int line = number / abreast_ % lines_per_layer_;
    const int layer = number / abreast_ / lines_per_layer_;
    const double rank = (place + 1) / 2; // NOLINT(bugprone-integer-division): whole ranks
    const double side = place % 2 == 1 ? 1.0 : -1.0;
    const double heading_rad = euler_from_body_to_world(leader.body_to_world).heading_rad;
    const glm::dvec3 ahead = direction_from_heading(heading_rad);
    const glm::dvec3 right(ahead.y, -ahead.x, 0.0);
    sim::AircraftState state = leader;
    state.position_m += rank * (side * lateral_spacing_m_ * right - trail_spacing_m_ * ahead);
    state.position_m += glm::dvec3(0.0, 0.0, line * lateral_spacing_m_) - layer * 2.0 * lateral_spacing_m_ * ahead;
    return state;
}

double Formation::framed_radius_m(double leader_radius_m) const {
    // The camera stands three radii behind and sees a little more than a third of a right angle to either side.
    constexpr double distances_per_aside = 2.2;
    const double distance_m = wingmen_per_side_ * (distances_per_aside * lateral_spacing_m_ + trail_spacing_m_);
    return std::max(leader_radius_m, distance_m / 3.0);
}

double largest_radius_m(const planning::Scene& scene) {
    double largest_m = 0.0;
    for (const std::uint32_t model : scene.aircraft) {
        largest_m = std::max(largest_m, scene.models[model]->subject.radius_m);
    }
    return largest_m;
}

Formation formation_of(const planning::Scene& scene, const PlacedFlight& flight) {
    const std::size_t own = std::min(flight.other_trajectories.size(), scene.aircraft.size() - 1);
    return {static_cast<int>(scene.aircraft.size() - own), largest_radius_m(scene)};
}

void formation_states(const PlacedFlight& flight, const Formation& formation, const sim::AircraftState& leader,
    double time_s, std::span<sim::AircraftState> states) {
    states.front() = leader;
    int number = 0;
    for (std::size_t i = 1; i < states.size(); ++i) {
        const auto own = flight.other_trajectories.find(i);
        if (own == flight.other_trajectories.end()) {
            states[i] = formation.wingman_state(leader, ++number);
            continue;
        }
        const sim::Trajectory& path = own->second;
        states[i] = path.state_at(time_s);
        states[i].time_s = leader.time_s;
        states[i].is_present = time_s >= path.start_s() && time_s <= path.end_s();
    }
}

} // namespace octant::ui::world
