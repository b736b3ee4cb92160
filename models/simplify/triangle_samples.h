#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace octant::models::simplify {

/// A position on a triangle.
struct TriangleSample {
    glm::dvec3 weights{0.0}; ///< The barycentric weights of the corners.
    double share = 0.0;      ///< The share of the area that it stands for.
};

/// The nodes of a triangular grid with `fields` fields along each side, the border included. Sums
/// over it are exact for functions that are linear on each field.
std::vector<TriangleSample> sample_grid(int fields);

/// The centroids of the fields of such a grid; none is on the border.
std::vector<TriangleSample> middle_grid(int fields);

/// The barycentric weights of point `i` of an infinite sequence whose first points are evenly
/// spread over a triangle, however many are used.
glm::dvec3 spread_weights(std::size_t i);

} // namespace octant::models::simplify
