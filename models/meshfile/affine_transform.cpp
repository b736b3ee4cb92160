#include "models/meshfile/affine_transform.h"

#include "models/meshfile/mesh_limits.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace octant::models::meshfile {

std::optional<glm::dvec3> AffineTransform::point_m(const glm::dvec3& own_m) const {
    const glm::dvec3 place_m = turn * own_m + shift_m;
    for (int part = 0; part < 3; ++part) {
        if (!(std::abs(place_m[part]) <= max_coordinate)) { // also NaN
            return std::nullopt;
        }
    }
    return place_m;
}

glm::dvec3 AffineTransform::normal(const glm::dvec3& own) const {
    if (turn == glm::dmat3(1.0)) { return own; }
    // The matrix of cofactors: the inverse's transpose times the determinant, which mirrors change.
    const glm::dmat3 cofactors(
        glm::cross(turn[1], turn[2]), glm::cross(turn[2], turn[0]), glm::cross(turn[0], turn[1]));
    return (mirrors() ? -1.0 : 1.0) * (cofactors * own);
}

bool AffineTransform::mirrors() const { return glm::determinant(turn) < 0.0; }

} // namespace octant::models::meshfile
