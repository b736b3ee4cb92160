#include "models/planar/decimal_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace octant::models::planar {

namespace {

/// What reading a decimal, moving or scaling it, and looking at it here may round off a number, as
/// a share of it. (Each of these steps rounds by at most half an epsilon.)
constexpr double rounding_share = 2.5 * std::numeric_limits<double>::epsilon();
/// Decimal steps finer than so many of these, of the largest coordinate, are not told from noise:
/// of numbers without a grid one in eight lies that near to a multiple.
constexpr double min_roundings = 16.0;

/// Whether a number is a multiple of 10 to some power but for rounding. Powers above 1 are exact,
/// their inverses are not.
bool is_multiple(double value, int power) {
    const double scale = std::pow(10.0, std::abs(power));
    const double nearest =
        power < 0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
    return std::abs(value - nearest) <= rounding_share * std::abs(value);
}

} // namespace

double decimal_grid(std::span<const glm::dvec3> points) {
    double most = 0.0;
    std::vector<double> values;
    for (const glm::dvec3& point : points) {
        for (const double value : {point.x, point.y, point.z}) {
            most = std::max(most, std::abs(value));
            values.push_back(value);
        }
    }
    if (most == 0.0) {
        return 0.0;
    }
    const double least = min_roundings * rounding_share * most;
    for (int power = static_cast<int>(std::floor(std::log10(most)));; --power) {
        const double step = std::pow(10.0, power);
        if (step <= least) {
            return 0.0;
        }
        if (std::ranges::all_of(values, [&](double value) { return is_multiple(value, power); })) {
            return step;
        }
    }
}

} // namespace octant::models::planar
