#pragma once

#include <cstdint>

namespace octant::models::made {

/// Uniform in [0, 1), from integer arithmetic alone.
double hashed_unit(std::uint64_t seed, std::int64_t x, std::int64_t y);

/// Smooth noise of one wavelength in about [-1, 1], zero on average. Coordinates in wavelengths.
double gradient_noise(std::uint64_t seed, double x, double y);

/// Octaves of gradient_noise from `wavelength_m` down, each half as long and `gain` times as high;
/// about [-1, 1].
struct Fractal {
    std::uint64_t seed = 0;
    double wavelength_m = 1000.0;
    int octaves = 4;
    double gain = 0.5;

    double at(double x_m, double y_m) const;
};

/// A sideways displacement that bends straight lines: three octaves from `wavelength_m` down, each
/// shifting by up to about a seventh of its own wavelength, so that it never folds.
struct Warp {
    std::uint64_t seed = 0;
    double wavelength_m = 1000.0;
    int octaves = 3;

    double east_m(double x_m, double y_m) const;
    double north_m(double x_m, double y_m) const;
};

/// 0 below `low`, 1 above `high`, a smooth transition between them.
double smooth_step(double low, double high, double value);

} // namespace octant::models::made
