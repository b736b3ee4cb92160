// Source: K. Perlin, Improving Noise, SIGGRAPH 2002 (quintic fade, gradients at lattice points);
// the integer mixer is SplitMix64's finalizer (Steele, Lea and Flood 2014).
// Deviations: gradients are hashed vectors of any length up to 1.4, not a table of twelve, so that
// no direction of the lattice is favoured. Only + - * / and conversions are used: the same bits in
// every build.
#include "models/made/terrain_noise.h"

#include <algorithm>

namespace octant::models::made {

namespace {

std::uint64_t mixed(std::uint64_t value) {
    value += 0x9e3779b97f4a7c15ULL;
    value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    value = (value ^ (value >> 27U)) * 0x94d049bb133111ebULL;
    return value ^ (value >> 31U);
}

std::uint64_t hashed(std::uint64_t seed, std::int64_t x, std::int64_t y) {
    const auto a = static_cast<std::uint64_t>(x) * 0xd6e8feb86659fd93ULL;
    const auto b = static_cast<std::uint64_t>(y) * 0xa0761d6478bd642fULL;
    return mixed(seed * 0x9fb21c651e98df25ULL ^ a ^ (b + (b >> 29U)));
}

/// The same as a double, of at most 63 bits: processors convert signed numbers only.
double as_double(std::uint64_t bits) {
    return static_cast<double>(static_cast<std::int64_t>(bits));
}

inline double slope_term(std::uint64_t seed, std::int64_t x, std::int64_t y, double dx, double dy) {
    constexpr double to_unit = 1.0 / 2147483648.0;
    const std::uint64_t bits = hashed(seed, x, y);
    const double gx = as_double(bits & 0xffffffffU) * to_unit - 1.0;
    const double gy = as_double(bits >> 32U) * to_unit - 1.0;
    return gx * dx + gy * dy;
}

/// std::floor without its call, for what fits the type.
std::int64_t floor_of(double value) {
    const auto whole = static_cast<std::int64_t>(value);
    return static_cast<double>(whole) > value ? whole - 1 : whole;
}

double fade(double t) {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

} // namespace

double hashed_unit(std::uint64_t seed, std::int64_t x, std::int64_t y) {
    return as_double(hashed(seed, x, y) >> 11U) * (1.0 / 9007199254740992.0);
}

double gradient_noise(std::uint64_t seed, double x, double y) {
    const std::int64_t column = floor_of(x);
    const std::int64_t row = floor_of(y);
    const double dx = x - static_cast<double>(column);
    const double dy = y - static_cast<double>(row);
    const double u = fade(dx);
    const double low = slope_term(seed, column, row, dx, dy) * (1.0 - u) +
                       slope_term(seed, column + 1, row, dx - 1.0, dy) * u;
    const double high = slope_term(seed, column, row + 1, dx, dy - 1.0) * (1.0 - u) +
                        slope_term(seed, column + 1, row + 1, dx - 1.0, dy - 1.0) * u;
    const double v = fade(dy);
    return 1.6 * (low * (1.0 - v) + high * v);
}

double Fractal::at(double x_m, double y_m) const {
    double sum = 0.0;
    double weight = 1.0;
    double weights = 0.0;
    double x = x_m / wavelength_m;
    double y = y_m / wavelength_m;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += weight * gradient_noise(seed + static_cast<std::uint64_t>(octave) * 1013U, x, y);
        weights += weight;
        weight *= gain;
        // Each octave is turned by the angle of (3, 4, 5), so that lattices never line up.
        const double turned = 2.0 * (0.8 * x - 0.6 * y);
        y = 2.0 * (0.6 * x + 0.8 * y) + 17.3;
        x = turned - 5.7;
    }
    return sum / weights;
}

double Warp::east_m(double x_m, double y_m) const {
    const Fractal shift = {seed, wavelength_m, octaves, 0.5};
    return 0.25 * wavelength_m * shift.at(x_m, y_m);
}

double Warp::north_m(double x_m, double y_m) const {
    const Fractal shift = {seed + 500009U, wavelength_m, octaves, 0.5};
    return 0.25 * wavelength_m * shift.at(x_m, y_m);
}

double smooth_step(double low, double high, double value) {
    const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

} // namespace octant::models::made
