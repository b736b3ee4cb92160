#pragma once

#include "sim/aircraft_state.h"
#include "ui/world/path_placement.h"
#include "visuals/planning/scene.h"

#include <span>

namespace octant::ui::world {

/// Where wingmen fly, in the leader's attitude and far enough apart for the largest of them: up to eight nearly abreast
/// of him, alternately to his right and left; more in lines one above and one behind the other, so that a thousand are
/// a block of ten by ten by ten.
class Formation {
public:
    /// `aircraft` >= 1 with the leader; `largest_radius_m` of any of them.
    Formation(int aircraft, double largest_radius_m);

    /// State of wingman `number` (from 1).
    sim::AircraftState wingman_state(const sim::AircraftState& leader, int number) const;

    /// Radius of the sphere that a chase camera should frame, so that all are in its picture: the leader's own radius
    /// unless the formation is too wide for it.
    double framed_radius_m(double leader_radius_m) const;

private:
    /// Aircraft in a line, the leader's place among them.
    int abreast_;
    /// Lines one above the other, in each layer.
    int lines_per_layer_;
    /// Wingmen to one side of a line's middle.
    int wingmen_per_side_;
    /// Sideways distance of neighbours in a line.
    double lateral_spacing_m_;
    /// Distance of neighbours along the flight.
    double trail_spacing_m_;
};

/// Of all aircraft of a scene.
double largest_radius_m(const visuals::planning::Scene& scene);

/// The formation of those aircraft that fly no path of their own.
Formation formation_of(const visuals::planning::Scene& scene, const PlacedFlight& flight);

/// The states of all aircraft at a time at which the first one's is `leader`.
void formation_states(const PlacedFlight& flight, const Formation& formation, const sim::AircraftState& leader,
    double time_s, std::span<sim::AircraftState> states);

} // namespace octant::ui::world
