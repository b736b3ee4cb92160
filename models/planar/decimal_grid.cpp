#include "models/planar/decimal_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace octant::models::planar {

namespace {

/// Decimal steps finer than so many roundings of the largest coordinate are not told from noise.
constexpr double least_roundings = 64.0;

/// Whether a number is a multiple of a step but for the rounding of its last bits.
bool is_multiple(double value, double step) {
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(value);
    return std::abs(value - std::round(value / step) * step) <= rounding;
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
    const double least = least_roundings * std::numeric_limits<double>::epsilon() * most;
    for (double power = std::floor(std::log10(most)); std::pow(10.0, power) > least; power -= 1.0) {
        const double step = std::pow(10.0, power);
        if (std::ranges::all_of(values, [&](double value) { return is_multiple(value, step); })) {
            return step;
        }
    }
    return 0.0;
}

} // namespace octant::models::planar
