#pragma once

#include "flightpaths/track_inference.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace octant::flightpaths {

/// What is known of the motion through the air, one entry for each time; NaN where nothing is.
struct AirData {
    std::span<const double> times_s;
    /// Over the ground.
    std::span<const glm::dvec3> velocities_mps;
    std::vector<double> airspeeds_mps;
    std::vector<double> headings_rad;
};

/// The wind along a track.
class WindEstimate {
public:
    WindEstimate() = default;

    /// From circles flown, and from measured airspeeds and headings: the wind that makes the airspeed of a stretch the
    /// most even, or the measured one.
    explicit WindEstimate(const AirData& air);

    /// The mean of the estimates near a time; no wind far from all of them.
    glm::dvec2 wind_mps(double time_s) const;

    /// For each stretch that showed a wind.
    const std::vector<TrackInference::Wind>& winds() const { return winds_; }

private:
    struct Estimate {
        double time_s = 0.0;
        glm::dvec2 wind_mps{0.0};
        double variance = 0.0;
    };

    std::vector<Estimate> estimates_;
    std::vector<TrackInference::Wind> winds_;
};

} // namespace octant::flightpaths
