#include "models/planar/file_precision.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace octant::models::planar {

namespace {

/// Decimal steps finer than so many roundings of the largest coordinate are not told from noise.
constexpr double least_roundings = 64.0;

double largest_of(std::span<const glm::dvec3> points) {
    double most = 0.0;
    for (const glm::dvec3& point : points) {
        most = std::max({most, std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    }
    return most;
}

/// The coordinates of at least a tenth of the largest one.
std::vector<double> large_coordinates(std::span<const glm::dvec3> points) {
    const double most = largest_of(points);
    std::vector<double> large;
    for (const glm::dvec3& point : points) {
        for (const double value : {point.x, point.y, point.z}) {
            if (std::abs(value) >= 0.1 * most) {
                large.push_back(value);
            }
        }
    }
    return large;
}

/// Whether a number is a multiple of a step but for the rounding of its last bits.
bool is_multiple(double value, double step) {
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(value);
    return std::abs(value - std::round(value / step) * step) <= rounding;
}

/// The largest power of ten that all values are multiples of, 0 where there is none; `most` is the
/// largest of them.
double decimal_step(std::span<const double> values, double most) {
    const double least = least_roundings * std::numeric_limits<double>::epsilon() * most;
    for (double power = std::floor(std::log10(most)); std::pow(10.0, power) > least; power -= 1.0) {
        const double step = std::pow(10.0, power);
        if (std::ranges::all_of(values, [&](double value) { return is_multiple(value, step); })) {
            return step;
        }
    }
    return 0.0;
}

} // namespace

double file_precision(std::span<const glm::dvec3> points) {
    assert(!points.empty());
    const double most = largest_of(points);
    const std::vector<double> large = large_coordinates(points);
    if (const double step = most > 0.0 ? decimal_step(large, most) : 1.0; step > 0.0) {
        return step;
    }
    const bool single = std::ranges::all_of(large, [](double value) {
        return static_cast<double>(static_cast<float>(value)) == value;
    });
    const double spacing = single ? static_cast<double>(std::numeric_limits<float>::epsilon())
                                  : std::numeric_limits<double>::epsilon();
    return most * spacing;
}

double decimal_grid(std::span<const glm::dvec3> points) {
    const double most = largest_of(points);
    std::vector<double> values;
    for (const glm::dvec3& point : points) {
        values.insert(values.end(), {point.x, point.y, point.z});
    }
    return most > 0.0 ? decimal_step(values, most) : 0.0;
}

} // namespace octant::models::planar
