#include "models/planar/file_precision.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace octant::models::planar {

namespace {

constexpr int most_decimals = 9;

/// The coordinates of at least a tenth of the largest one.
std::vector<double> large_coordinates(std::span<const glm::dvec3> points) {
    double most = 0.0;
    for (const glm::dvec3& point : points) {
        most = std::max({most, std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    }
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

} // namespace

double file_precision(std::span<const glm::dvec3> points) {
    assert(!points.empty());
    const std::vector<double> large = large_coordinates(points);
    for (int decimals = 0; decimals <= most_decimals; ++decimals) {
        const double step = std::pow(10.0, -decimals);
        if (std::ranges::all_of(large, [&](double value) { return is_multiple(value, step); })) {
            return step;
        }
    }
    const double most = std::abs(
        *std::ranges::max_element(large, {}, [](double value) { return std::abs(value); }));
    const bool single = std::ranges::all_of(large, [](double value) {
        return static_cast<double>(static_cast<float>(value)) == value;
    });
    const double spacing = single ? static_cast<double>(std::numeric_limits<float>::epsilon())
                                  : std::numeric_limits<double>::epsilon();
    return most * spacing;
}

} // namespace octant::models::planar
