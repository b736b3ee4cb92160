#pragma once

#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace octant {

/// A generator of random numbers that are the same with every compiler and library.
class RandomGenerator {
public:
    explicit RandomGenerator(std::uint64_t seed) : state_(seed) {}

    /// A number spread evenly over 0 <= x < 1.
    double next() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state_ >> 11U) * 0x1p-53;
    }

    double between(double min, double max) { return min + (max - min) * next(); }

    /// A number that is about normally distributed, with mean 0 and standard deviation 1.
    double normal_deviate() {
        double sum = -6.0;
        for (int i = 0; i < 12; ++i) { sum += next(); }
        return sum;
    }

    /// A unit vector; all directions are equally likely.
    glm::dvec3 direction() {
        const double z = between(-1.0, 1.0);
        const double angle_rad = between(0.0, 2.0 * std::numbers::pi);
        const double across = std::sqrt(1.0 - z * z);
        return {across * std::cos(angle_rad), across * std::sin(angle_rad), z};
    }

private:
    std::uint64_t state_;
};

} // namespace octant
