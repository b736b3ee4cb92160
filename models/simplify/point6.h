#pragma once

#include <array>
#include <cstddef>

namespace octant::models::simplify {

/// A position and a weighted colour as one point: x, y, z (metres), w r, w g, w b; the last three 0
/// where colour does not count.
struct Point6 {
    static constexpr std::size_t size = 6;

    std::array<double, size> parts{};

    double& operator[](std::size_t i) { return parts[i]; }

    double operator[](std::size_t i) const { return parts[i]; }
};

inline Point6 operator-(const Point6& a, const Point6& b) {
    Point6 difference;
    for (std::size_t i = 0; i < Point6::size; ++i) {
        difference[i] = a[i] - b[i];
    }
    return difference;
}

/// a + t b.
inline Point6 along(const Point6& a, double t, const Point6& b) {
    Point6 sum;
    for (std::size_t i = 0; i < Point6::size; ++i) {
        sum[i] = a[i] + t * b[i];
    }
    return sum;
}

inline Point6 middle(const Point6& a, const Point6& b) {
    Point6 mean;
    for (std::size_t i = 0; i < Point6::size; ++i) {
        mean[i] = 0.5 * (a[i] + b[i]);
    }
    return mean;
}

inline double dot(const Point6& a, const Point6& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < Point6::size; ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}

inline double squared_distance(const Point6& a, const Point6& b) {
    const Point6 difference = a - b;
    return dot(difference, difference);
}

} // namespace octant::models::simplify
