#pragma once

#include "sim/aircraft_state.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/trajectory.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace octant::flightpaths {

/// The smallest curve above `needed_m` that rises by at most `up_m[i]` from i to i+1 and falls by at most `down_m[i]`.
/// All three have the same length.
std::vector<double> slope_limited(
    std::vector<double> needed_m, const std::vector<double>& up_m, const std::vector<double>& down_m);

struct PlacementOptions {
    /// World position of the origin of the path.
    glm::dvec2 place_m{0.0};
    /// Clockwise turn of the whole path about its origin; 0 keeps its north. Not given: the one of 24 headings (15
    /// degrees apart) whose ground has the smallest height difference, the lowest heading among equals; headings that
    /// leave the map are ignored. If all 24 leave it, the same with the middle of the path (of its bounding box) at the
    /// position.
    std::optional<double> heading_rad;
    sim::HeightMode mode = sim::HeightMode::Clear;
    /// Only what is flown from here to there is looked at: the rest may leave the map or meet the ground.
    double from_s = -std::numeric_limits<double>::infinity();
    double to_s = std::numeric_limits<double>::infinity();
    /// Whether it is enough that some of it lies over the map; a note then says how long it is beside it.
    bool may_leave_map = false;
};

struct PlacedPath {
    sim::Trajectory trajectory;
    /// Height added to the whole path; when following, the smallest added height.
    double offset_m = 0.0;
    double heading_rad = 0.0;
    /// World position of the origin of the path.
    glm::dvec2 origin_m{0.0};
    double lowest_clearance_m = 0.0;
    double lowest_clearance_at_s = 0.0;
    /// Notes, one sentence each, about wishes that were not met.
    std::vector<std::string> notes;
};

/// Thrown if a path leaves the map; the text says when and where.
class OutsideMapError : public Error {
public:
    using Error::Error;
};

/// Places a path over ground. A clearance is the height of the reference point of the aircraft (the origin of its body
/// axes) over the ground directly below; lower parts of the aircraft are ignored. Clearances are checked every 1/120 s
/// along the curve of the trajectory. HeightMode::Follow guarantees `min_clearance_m` as Clear does; only Follow needs
/// the limits of the aircraft (asserted). Throws Error with time and place if the path leaves the map (OutsideMapError)
/// or, in any mode, meets the ground: at datum heights, or if `min_clearance_m` is not above zero.
PlacedPath place_over_ground(const sim::Trajectory& path, const PlacementOptions& placement, const GroundHeight& ground,
    double min_clearance_m, const std::optional<sim::AircraftLimits>& limits);

/// Moves, turns and lifts another path like one that was placed.
sim::Trajectory with_same_placement(const sim::Trajectory& path, const PlacedPath& placed);

/// Checks a path in world axes every 1/120 s as place_over_ground() does. Throws the same Error if the path leaves the
/// map or meets the ground.
void check_over_ground(const sim::Trajectory& in_world, const GroundHeight& ground);

} // namespace octant::flightpaths
