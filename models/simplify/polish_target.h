#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/simplify/target_mesh.h"

#include <glm/vec3.hpp>

#include <limits>
#include <optional>

namespace octant::models::simplify {

/// The surface that is approximated, in working units, with a tree over its triangles.
struct PolishTarget {
    const TargetMesh& mesh;
    const measure::TriangleBvh& bvh;
};

/// The weight of a sample that aims at a farther point facing its way, relative to one that aims at
/// its nearest point.
inline constexpr double turned_pull = 10.0;

/// Finds the nearest points of the target for a series of positions that are close to each other:
/// the distance of the last one bounds that of the next.
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

/// Whether no triangle of the target within twice the distance of the nearest point faces as
/// `normal` does, so that the surface is folded over at `place`: the criterion of
/// measure::flipped_area_share.
bool is_against(
    const PolishTarget& target,
    const glm::dvec3& place,
    const measure::NearestOnMesh& nearest,
    const glm::dvec3& normal);

/// The nearest point, at most `within` away, of a triangle that faces as `normal` does; nothing if
/// there is none.
std::optional<glm::dvec3> nearest_alike(
    const PolishTarget& target, const glm::dvec3& place, const glm::dvec3& normal, double within);

} // namespace octant::models::simplify
