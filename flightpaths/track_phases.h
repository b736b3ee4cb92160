#pragma once

#include "flightpaths/track_inference.h"
#include "flightpaths/track_recording.h"

#include <glm/vec3.hpp>

#include <span>
#include <string_view>
#include <vector>

namespace octant::flightpaths {

/// A path with what is known of its contact with the ground, one entry for each time.
struct PathKinematics {
    std::vector<double> times_s;
    std::vector<glm::dvec3> positions_m;
    std::vector<glm::dvec3> velocities_mps;
    std::vector<glm::dvec3> accelerations_mps2;
    std::vector<GroundContact> contacts;
    /// Standard deviation of heights that were measured.
    double vertical_error_m = 0.0;
};

struct PathPhases {
    /// One for each time.
    std::vector<TrackPhase> phases;
    bool hovers = false;
};

/// Below this an aircraft stands or drifts.
inline constexpr double walking_pace_mps = 1.4;

/// What an aircraft does at each time, by its speeds, heights and recorded contacts alone: no ground is known. `type`
/// may have tags such as "Air+Rotorcraft"; otherwise an aircraft hovers if it climbs or sinks on one spot.
PathPhases phases_of(const PathKinematics& path, std::string_view type);

/// Runs of equal phases.
std::vector<PhaseSpan> spans_of(const std::vector<TrackPhase>& phases, std::span<const double> times_s);

} // namespace octant::flightpaths
