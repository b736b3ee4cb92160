#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace octant::models::simplify {

/// A place on a triangle.
struct TriangleSample {
    glm::dvec3 weights{0.0}; ///< of the triangle's corners
    double share = 0.0;      ///< of its area that it stands for
};

/// A grid of so many fields a side on a triangle, with its border: sums over it are exact for
/// functions linear on the fields.
std::vector<TriangleSample> sample_grid(int fields);

/// The middles of the fields of such a grid: none on the border.
std::vector<TriangleSample> middle_grid(int fields);

/// Corner weights of place `i` of a sequence that fills a triangle ever more densely and, at any
/// length, evenly.
glm::dvec3 spread_weights(std::size_t i);

} // namespace octant::models::simplify
