// Nearest points of the target that lie on the right side. In a part thinner than the error, the
// nearest point alone may be on the opposite side, and least squares would then turn triangles
// over.
#include "models/simplify/polish_target.h"

#include "models/measure/nearest_point.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace octant::models::simplify {

namespace {

/// Positive where a triangle faces as `normal` does, negative where it faces against it.
double facing(const PolishTarget& target, std::uint32_t face, const glm::dvec3& normal) {
    return glm::dot(area_vector(target.mesh.corner_places(face)), normal);
}

/// The nearest point of one triangle of the target.
measure::NearestOnTriangle
nearest_on(const PolishTarget& target, std::uint32_t face, const glm::dvec3& place) {
    const std::array<glm::dvec3, 3> corners = target.mesh.corner_places(face);
    return measure::nearest_on_triangle(place, corners[0], corners[1], corners[2]);
}

} // namespace

measure::NearestOnMesh NearestInTurn::nearest(const glm::dvec3& place) {
    constexpr double margin = 1.0 + 1e-9; // Makes up for the rounding of square roots and sums.
    const double within = margin * (last_off_ + glm::distance(last_, place)) + bvh_->rounding_m();
    const measure::NearestOnMesh found = bvh_->nearest(place, within);
    last_ = place;
    last_off_ = std::sqrt(found.distance2);
    return found;
}

bool is_against(
    const PolishTarget& target,
    const glm::dvec3& place,
    const measure::NearestOnMesh& nearest,
    const glm::dvec3& normal) {
    if (!(facing(target, nearest.triangle, normal) < 0.0)) {
        return false;
    }
    const double within = 2.0 * std::sqrt(nearest.distance2) + target.bvh.rounding_m();
    bool against = true;
    target.bvh.for_each_near(place, within, [&](std::uint32_t face) {
        against = against && (facing(target, face, normal) < 0.0 ||
                              nearest_on(target, face, place).distance2 > within * within);
    });
    return against;
}

std::optional<glm::dvec3> nearest_alike(
    const PolishTarget& target, const glm::dvec3& place, const glm::dvec3& normal, double within) {
    // What is found within a part of the way is the nearest, and far fewer triangles are looked at.
    for (const double part : {0.125, 0.25, 0.5, 1.0}) {
        double least2 = part * within * part * within;
        // Of several triangles at the same distance the one with the lowest number counts.
        std::uint32_t found_on = none;
        std::optional<glm::dvec3> found;
        target.bvh.for_each_near(place, part * within, [&](std::uint32_t face) {
            if (!(facing(target, face, normal) > 0.0)) {
                return;
            }
            const measure::NearestOnTriangle nearest = nearest_on(target, face, place);
            if (nearest.distance2 < least2 || (nearest.distance2 == least2 && face < found_on)) {
                least2 = nearest.distance2;
                found_on = face;
                found = nearest.point;
            }
        });
        if (found) {
            return found;
        }
    }
    return std::nullopt;
}

} // namespace octant::models::simplify
