#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

// Motion along one axis from measurements with errors, by a fixed-interval Kalman smoother: what is measured later
// counts as much as what was measured before, so nothing lags. Acceleration is a random process: white jerk of a
// spectral density drives it, and it decays to zero over memory_s.

namespace octant::flightpaths {

/// What is known of one axis at one time; a variance of infinity means nothing.
struct AxisMeasurement {
    double position_m = 0.0;
    double position_variance = std::numeric_limits<double>::infinity();
    double velocity_mps = 0.0;
    double velocity_variance = std::numeric_limits<double>::infinity();
};

struct AxisMotion {
    double position_m = 0.0;
    double velocity_mps = 0.0;
    double acceleration_mps2 = 0.0;
    /// Variances of position and velocity.
    double position_variance = 0.0;
    double velocity_variance = 0.0;
};

/// Times that increase, and what was measured of an axis at each of them. At least one position is measured.
struct AxisSeries {
    std::span<const double> times_s;
    std::span<const AxisMeasurement> measured;
    /// Time in which an acceleration that nothing keeps up falls to 1/e.
    double memory_s = 20.0;
};

/// Densities of jerk that are tried, m^2/s^5, from an aircraft at rest to aerobatics.
inline constexpr std::array jerk_densities{1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0, 100.0};

/// The most likely motion at all times; `jerk[i]` is the density from time i-1 to time i.
std::vector<AxisMotion> smoothed(const AxisSeries& series, std::span<const double> jerk);

struct JerkFit {
    /// For each time, as smoothed() takes it.
    std::vector<double> jerk;
    /// Of the measurements, given their variances and the best densities.
    double log_likelihood = 0.0;
};

/// The density of jerk at each time under which the measurements near it are most likely: of all jerk_densities by
/// their likelihood. The axes have the same times and memory and share it. Single measurements that contradict all
/// others do not count.
JerkFit fitted_jerk(std::span<const AxisSeries> axes);

} // namespace octant::flightpaths
