#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <limits>
#include <optional>

namespace octant::models::simplify {

/// The surface that is approached, in working units.
struct PolishTarget {
    const WorkingSurface& surface;
    const measure::TriangleBvh& bvh;
};

/// How much a sample pulls to the side that faces its way, beside one whose nearest place does.
inline constexpr double turned_pull = 10.0;

/// Finds the nearest places of the target for places that lie close one after the other.
class NearestInTurn {
public:
    explicit NearestInTurn(const PolishTarget& target)
        : bvh_(&target.bvh) {}

    measure::NearestOnMesh nearest(const glm::dvec3& place);

private:
    const measure::TriangleBvh* bvh_;
    glm::dvec3 last_{0.0};
    double last_off_ = std::numeric_limits<double>::infinity();
};

/// Whether no triangle of the target within twice the distance of the nearest one faces the way of
/// `normal`: as measure::flipped_area_share looks at it.
bool is_against(
    const PolishTarget& target,
    const glm::dvec3& place,
    const measure::NearestOnMesh& nearest,
    const glm::dvec3& normal);

/// The nearest place, at most `within` away, of a triangle that faces that way.
std::optional<glm::dvec3> nearest_alike(
    const PolishTarget& target, const glm::dvec3& place, const glm::dvec3& normal, double within);

} // namespace octant::models::simplify
