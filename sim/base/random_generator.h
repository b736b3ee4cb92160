#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace octant {

/// Numbers from a small generator of its own, the same with every library.
class RandomGenerator {
public:
    explicit RandomGenerator(std::uint64_t seed) : state_(seed) {}

    /// A number spread evenly over 0 <= x < 1.
    double next() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state_ >> 11U) * 0x1p-53;
    }

    double between(double least, double most) { return least + (most - least) * next(); }

    /// A number that is about normally distributed, with mean 0 and standard deviation 1.
    double normal_deviate() {
        double sum = -6.0;
        for (int i = 0; i < 12; ++i) { sum += next(); }
        return sum;
    }

    /// A unit vector; all directions are equally likely.
    glm::dvec3 direction();

private:
    std::uint64_t state_;
};

} // namespace octant
