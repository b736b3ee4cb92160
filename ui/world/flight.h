#pragma once

#include "flightpaths/fly_script.h"
#include "sim/trajectory.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace octant::ui::world {

/// A path as it is flown over the ground of a run.
struct Flight {
    /// States in world axes.
    sim::Trajectory trajectory;
    std::string title;
    /// Samples a second.
    double rate_hz = 20.0;
    /// Where the path's origin lies.
    glm::dvec2 place_m{0.0};
    /// How far the path was turned, clockwise.
    double heading_rad = 0.0;
    /// How far the path was lifted.
    double offset_m = 0.0;
    /// The least height above the ground, and when it is flown at.
    double lowest_clearance_m = 0.0;
    double lowest_clearance_s = 0.0;
    std::vector<flightpaths::LegStart> legs;
    /// Of aircraft that fly a path of their own, by their numbers and by the first one's clock, in world axes; before
    /// its start and after its end such an aircraft is not there.
    std::map<std::size_t, sim::Trajectory> other_trajectories;
};

} // namespace octant::ui::world
