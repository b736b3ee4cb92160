#pragma once

#include "sim/aircraft_state.h"
#include "sim/base/error.h"
#include "sim/base/ground_height.h"
#include "sim/height_mode.h"
#include "sim/trajectory.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <vector>

namespace octant::flightpaths {

struct RaisedPath {
    sim::Trajectory trajectory;
    /// False where nothing but one lift for all heights fits the limits.
    bool follows = true;
};

/// Lifts a path over ground, changing in time.
///
/// `needed_m` is what must at least be added to the path's height at each step of sim::step_s from its start; the
/// result adds at least that at every step. It climbs no faster than the aircraft can beside what the path climbs
/// already, sinks no faster than it can climb, and both no steeper than 1 in 4. It is rounded over the shortest time
/// that keeps the load factor within half of the aircraft's margins (or near the path's own, where that is beyond) and
/// its onset within the limit; where no time does, or none short of levelling the whole path, that is lifted by one
/// height and `follows` is false.
///
/// Speed along the ground stays; velocity, pitch and load factor follow the new path; bank stays.
RaisedPath raised_over_ground(
    const sim::Trajectory& path, const std::vector<double>& needed_m, const sim::AircraftLimits& limits);

/// The smallest curve over `needed_m` that rises by at most `up_m[i]` from i to i+1 and falls by at most `down_m[i]`.
/// All three of one length.
std::vector<double> slope_limited(
    std::vector<double> needed_m, const std::vector<double>& up_m, const std::vector<double>& down_m);

struct PlacementOptions {
    /// Where the path's origin goes.
    glm::dvec2 place_m{0.0};
    /// Turn of the whole path about its origin, clockwise; 0 keeps its north. Not given: that one of 24 headings (15
    /// degrees apart) whose ground has the least height difference, the lowest heading among equals; headings that
    /// leave the map are passed over. If all 24 leave it, the same again with the middle of the path (of its bounding
    /// box) at the place.
    std::optional<double> heading_rad;
    sim::HeightMode mode = sim::HeightMode::Clear;
};

struct PlacedPath {
    sim::Trajectory trajectory;
    /// What was added to every height; when following, the least that was added.
    double offset_m = 0.0;
    double heading_rad = 0.0;
    /// Where the path's origin came to lie.
    glm::dvec2 origin_m{0.0};
    double lowest_clearance_m = 0.0;
    double lowest_clearance_at_s = 0.0;
    /// What was not done as wanted, a sentence each.
    std::vector<std::string> notes;
};

/// A path goes beyond the map; the text says when and where.
class OutsideMapError : public Error {
public:
    using Error::Error;
};

/// Puts a path over ground. A clearance is the height of the aircraft's reference point (the origin of its body axes)
/// over the ground right below it; lower parts of the aircraft are not looked at. Clearances are looked at every 1/120
/// s along the trajectory's curve. HeightMode::Follow guarantees `min_clearance_m` as Clear does; it alone needs the
/// limits of what flies (asserted). Throws Error with time and place when the path leaves the map (OutsideMapError) or,
/// in any mode, meets the ground: at datum heights, or where `min_clearance_m` is not above zero.
PlacedPath place_over_ground(const sim::Trajectory& path, const PlacementOptions& placement, const GroundHeight& ground,
    double min_clearance_m, const std::optional<sim::AircraftLimits>& limits);

/// Another path in the axes of one that was placed, moved, turned and lifted as that one was.
sim::Trajectory with_same_placement(const sim::Trajectory& path, const PlacedPath& placed);

/// Looks at a path in world axes, every 1/120 s along the trajectory's curve as place_over_ground does. Throws its
/// Error with time and place when the path leaves the map or meets the ground.
void check_over_ground(const sim::Trajectory& in_world, const GroundHeight& ground);

} // namespace octant::flightpaths
