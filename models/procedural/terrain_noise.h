#pragma once

#include <cstdint>
#include <span>

namespace octant::models::procedural {

/// Octaves of smooth noise from `wavelength_m` down, each half as long and `gain` times as high; about [-1, 1], zero on
/// average.
struct FractalNoise {
    std::uint64_t seed = 0;
    double wavelength_m = 1000.0;
    int octaves = 4;
    double gain = 0.5;

    /// Values at many places, metres; all three are of one length.
    void at(std::span<const double> x_m, std::span<const double> y_m, std::span<double> values) const;
};

/// A sideways displacement that bends straight lines: three octaves from `wavelength_m` down, each shifting by up to
/// about a seventh of its own wavelength, so that it never folds.
struct DomainWarp {
    std::uint64_t seed = 0;
    double wavelength_m = 1000.0;
    int octaves = 3;

    /// Moves places, metres, by so many times their displacement. Both are of one length.
    void move(std::span<double> x_m, std::span<double> y_m, double times) const;
};

/// 0 below `low`, 1 above `high`, a smooth transition between them.
double smooth_step(double low, double high, double value);

} // namespace octant::models::procedural
