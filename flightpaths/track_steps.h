#pragma once

#include "flightpaths/motion_smoother.h"
#include "flightpaths/track_inference.h"
#include "flightpaths/track_recording.h"
#include "sim/base/axes.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

// The steps of motion_of(), in their order: places (track_places.cpp), phases (track_phases.cpp), wind
// (track_wind.cpp), attitudes (track_attitude.cpp).

namespace octant::flightpaths {

/// Where an aircraft was, by all that was recorded of its places and velocities, within the errors that these show.
struct SmoothedPlaces {
    static constexpr std::size_t no_sample = std::numeric_limits<std::size_t>::max();

    /// The times of the samples, and times between them where they are more than 2.5 s apart.
    std::vector<double> times_s;
    /// The sample of each time; no_sample between two of them.
    std::vector<std::size_t> samples;
    /// East, north, up.
    std::array<std::vector<AxisMotion>, 3> axes;
    /// Standard deviations of the recorded places that were found.
    double horizontal_error_m = 0.0;
    double vertical_error_m = 0.0;
    /// Heights are rounded to multiples of this; 0: to none that matters.
    double height_step_m = 0.0;
    /// Samples whose place or height contradicts all others.
    long rejected = 0;
    /// Samples that repeat the place of the one before while the aircraft moves.
    long repeated = 0;

    glm::dvec3 position_m(std::size_t at) const;
    glm::dvec3 velocity_mps(std::size_t at) const;
    glm::dvec3 acceleration_mps2(std::size_t at) const;
};

/// Finds errors and rounding of the samples (at least two) and smooths their places.
class PlaceSmoother {
public:
    explicit PlaceSmoother(std::span<const TrackSample> samples);

    const SmoothedPlaces& places() const { return places_; }

    /// Smooths again, with the aircraft at rest at these times (one flag for each of places().times_s).
    void hold_at_rest(const std::vector<bool>& at_rest);

private:
    void fill_gaps();
    void measure_places();
    void measure_heights();
    void leave_out_jumps();
    void leave_out_repeats();
    void fit_horizontally();
    void fit_vertically();
    void measure_velocities();
    void smooth();
    AxisSeries series(std::size_t axis) const;

    std::span<const TrackSample> samples_;
    SmoothedPlaces places_;
    std::array<std::vector<AxisMeasurement>, 3> measured_;
    std::vector<double> horizontal_jerk_;
    std::vector<double> vertical_jerk_;
};

/// The step to which most of these heights are rounded, in order of time; 0 for none of at least half a metre.
double height_step_m(std::span<const double> heights_m);

/// A path with what is known of its contact with the ground, one entry for each time.
struct PathKinematics {
    std::vector<double> times_s;
    std::vector<glm::dvec3> positions_m;
    std::vector<glm::dvec3> velocities_mps;
    std::vector<glm::dvec3> accelerations_mps2;
    std::vector<GroundContact> contacts;
    /// Whether nothing was recorded there: a time within a gap. Empty where all were.
    std::vector<bool> filled;
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

/// One angle of a recording at the times of a path, rad; NaN where it was not measured.
using MeasuredAngle = std::vector<double>;

/// Attitudes that a motion asks for, one for each time of the path: see motion_of(). `headings_rad` are taken where
/// they were measured.
std::vector<EulerAngles> inferred_attitudes(
    const PathKinematics& path, const PathPhases& phases, const WindEstimate& wind, const MeasuredAngle& headings_rad);

/// Puts measured values of one angle in place of inferred ones; between measured ones the difference is interpolated,
/// and beyond half a minute from them it goes to zero.
void take_measured(std::span<const double> times_s, const MeasuredAngle& measured, double EulerAngles::*angle,
    std::vector<EulerAngles>& attitudes);

} // namespace octant::flightpaths
