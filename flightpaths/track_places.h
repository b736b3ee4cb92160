#pragma once

#include "flightpaths/motion_smoother.h"
#include "flightpaths/track_recording.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

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

} // namespace octant::flightpaths
