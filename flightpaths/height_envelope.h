#pragma once

#include <cstddef>
#include <vector>

// Running values of a height profile in equal steps. The mean over `half` places of the maxima over `half` places is
// nowhere below the profile.

namespace octant::flightpaths {

/// Largest value within `half` places to either side; the ends are repeated.
std::vector<double> running_max(const std::vector<double>& values, std::size_t half);

/// Smallest value within `half` places to either side.
std::vector<double> running_min(std::vector<double> values, std::size_t half);

/// Means over `half` places to either side, for the places that have them: 2 * half fewer values.
std::vector<double> running_mean(const std::vector<double>& values, std::size_t half);

/// The values with the first and the last one repeated `by` times before and after them.
std::vector<double> padded(const std::vector<double>& values, std::size_t by);

/// A smooth profile nowhere below the values: the maxima within 2 * half places, and twice their means over half
/// places.
std::vector<double> smooth_above(const std::vector<double>& values, std::size_t half);

/// From 0 to 1 as `share` goes from 0 to 1, without a bend at either end; outside 0 or 1.
double smooth_step(double share);

} // namespace octant::flightpaths
