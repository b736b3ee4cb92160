#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace octant::visuals::draworder {

/// Which eyes and polygons a ray test covers.
struct RayTestOptions {
    /// Whether parts with a pivot are tested, at four angles. False where no order can be right for them.
    bool turning_parts = true;
    /// Eyes are at least so far from where octants meet: |x| + |y| + |z| from there, metres.
    double min_distance_m = 0.0;
    glm::dvec3 centre_m{0.0};
    /// The order for those eyes alone, which is proved in place of the other; null: the order itself.
    const DrawOrder* proved_order = nullptr;
    /// About how long the proof may take on one core.
    double proof_s = 0.4;
};

/// The result of a ray test.
struct RayTestResult {
    long rays = 0;  ///< Rays that meet the front of a polygon away from its sides.
    long wrong = 0; ///< Of these, rays along which a polygon farther away was painted last.
    /// Pairs and polygons for which no proof was found (proof_walk.h).
    std::uint64_t unproved = 0;
    bool is_proof_complete = false; ///< Whether the proof came to the end of the order.
};

/// Tests an order before it is used, with none of the code that made it: from eyes far and near, close to the planes of
/// its nodes and close to polygons, at points of polygons; and by a proof. Pairs that it leaves open are looked at by
/// rays that one of the two would hide the other along. The work is bounded, some tenths of a second and the proof; the
/// same model and order give the same result.
RayTestResult ray_test_order(
    const models::polygons::PolygonModel& model, const DrawOrder& order, const RayTestOptions& scope);

} // namespace octant::visuals::draworder
