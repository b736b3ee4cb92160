// The quadrics of the previous measure: Y. Kim, B. U. Lee, "Error measure for vertex
// simplification", 2005, equations (1) and (2), after M. Garland, P. S. Heckbert, "Surface
// simplification using quadric error metrics", 1997, and "Simplifying surfaces with color and
// texture using quadric error metrics", 1998.
//
// Deviations: the paper does not say how the previous measure takes colour in; the second source is
// used. Planes are not weighted by area, as in (1).
#include "models/simplify/plane_quadric.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace octant::models::simplify {

namespace {

glm::dvec3 place(const Point6& x) {
    return {x[0], x[1], x[2]};
}

Point6 scaled(const Point6& x, double by) {
    return along({}, by, x);
}

} // namespace

PlaneQuadric PlaneQuadric::of_plane(const Corners& triangle) {
    PlaneQuadric quadric;
    const glm::dvec3 first_m = place(triangle[0]);
    const glm::dvec3 across =
        glm::cross(place(triangle[1]) - first_m, place(triangle[2]) - first_m);
    const double length = glm::length(across);
    if (length == 0.0) {
        return quadric;
    }
    const glm::dvec3 unit = across / length;
    const Point6 normal{unit.x, unit.y, unit.z, 0.0, 0.0, 0.0};
    const double offset_m = -glm::dot(unit, first_m);
    std::size_t k = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i; j < 6; ++j) {
            quadric.a_[k++] = normal[i] * normal[j];
        }
        quadric.b_[i] = offset_m * normal[i];
    }
    quadric.c_ = offset_m * offset_m;
    return quadric;
}

PlaneQuadric PlaneQuadric::of_coloured_plane(const Corners& triangle) {
    PlaneQuadric quadric;
    const Point6& p = triangle[0];
    Point6 first = triangle[1] - p;
    Point6 second = triangle[2] - p;
    const double first_length = std::sqrt(dot(first, first));
    if (first_length == 0.0) {
        return quadric;
    }
    first = scaled(first, 1.0 / first_length);
    second = along(second, -dot(first, second), first);
    const double second_length = std::sqrt(dot(second, second));
    if (second_length == 0.0) {
        return quadric;
    }
    second = scaled(second, 1.0 / second_length);
    const double p_first = dot(p, first);
    const double p_second = dot(p, second);
    std::size_t k = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i; j < 6; ++j) {
            quadric.a_[k++] = (i == j ? 1.0 : 0.0) - first[i] * first[j] - second[i] * second[j];
        }
        quadric.b_[i] = p_first * first[i] + p_second * second[i] - p[i];
    }
    quadric.c_ = dot(p, p) - p_first * p_first - p_second * p_second;
    return quadric;
}

void PlaneQuadric::add(const PlaneQuadric& other) {
    for (std::size_t i = 0; i < a_.size(); ++i) {
        a_[i] += other.a_[i];
    }
    b_ = along(b_, 1.0, other.b_);
    c_ += other.c_;
}

double PlaneQuadric::at(const Point6& x) const {
    double sum = c_;
    std::size_t k = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        double row = a_[k++] * x[i] + 2.0 * b_[i];
        for (std::size_t j = i + 1; j < 6; ++j) {
            row += 2.0 * a_[k++] * x[j];
        }
        sum += row * x[i];
    }
    return std::max(sum, 0.0);
}

} // namespace octant::models::simplify
