#pragma once

#include "flightpaths/fly_script.h"
#include "sim/aircraft_state.h"
#include "sim/trajectory.h"

#include <array>
#include <limits>
#include <string>

namespace octant::tests {

/// The shipped paths.
inline const std::array<std::string, 8> path_names{"f15-straight", "f15-jinking", "f15-pop-up", "f15-turn",
    "500md-straight", "500md-jinking", "500md-pop-up", "500md-turn"};

/// One of them as flown. Fails the test where it is not flown as its file says.
flightpaths::FlownPath flown(const std::string& name);

struct Range {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();

    void take(double value);
};

/// What a path was designed to.
struct Figures {
    Range load_factor, height_m, speed_mps, bank_deg, east_m, climb_deg;
    double length_m = 0.0;
    double nearest_m = std::numeric_limits<double>::infinity(); ///< to the site, on the ground
    double max_turn_degps = 0.0;                                ///< of the body
    double heading_change_deg = 0.0;                            ///< clockwise, whole path
};

Figures figures_of(const sim::Trajectory& path);
Figures figures_of(const std::string& name);

/// Angle between two attitudes.
double turn_between_rad(const sim::AircraftState& a, const sim::AircraftState& b);

double track_deg(const sim::AircraftState& state);

/// Time of a leg. Fails the test where there is none of that label.
double begin_of(const flightpaths::FlownPath& path, const std::string& label);

} // namespace octant::tests
