#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::draworder {

/// A polygon of a model as the rays of a test meet it, in radii of the model about its middle.
struct RayTarget {
    std::uint32_t polygon = 0;
    glm::dvec3 normal{0.0};
    glm::dvec3 middle{0.0};
    double radius = 0.0;
    std::vector<glm::dvec3> corners;
};

/// Where a ray meets the front of a target.
struct RayHit {
    /// Indices into RayTargets::all.
    std::size_t target = 0;
    double hit_distance = 0.0;
    /// How far inside the sides.
    double edge_distance = 0.0;
    /// How far along the ray it would be met if the target were moved by a hair. That is more for a ray that grazes it.
    double perturbed_distance = 0.0;
};

/// The polygons of a model at one angle of its turning parts.
class RayTargets {
public:
    /// In radii of the model: what lies nearer to a side than this is not counted, nor differences of depth below it. A
    /// little more than the inset of occlusion tests (Tolerances).
    static constexpr double ray_tolerance = 3e-9;

    explicit RayTargets(const models::polygons::PolygonModel& model);

    /// Turns the parts that have a pivot; without them unless `turning_parts`. Polygons without area are left out.
    void turn(double turn_rad, bool turning_parts);

    const std::vector<RayTarget>& all() const { return all_; }

    /// The target of a polygon; null where it has none.
    const RayTarget* of(std::uint32_t polygon) const;

    glm::dvec3 in_model_m(const glm::dvec3& at) const { return middle_m_ + at * radius_m_; }

    double radius_m() const { return radius_m_; }

    /// Sets the eye of the rays that follow, until the parts are turned.
    void set_eye(const glm::dvec3& eye);

    /// Replaces `hits` by all targets whose fronts a ray of unit length from the eye meets, in their order.
    void intersect(const glm::dvec3& ray, std::vector<RayHit>& hits) const;

private:
    /// A target whose front the eye sees. Most rays miss the ball around it, which is found out without the target:
    /// they do not pass its middle far enough along.
    struct FacingTarget {
        std::size_t target = 0;
        double height = 0.0; ///< Of the eye above the target's plane.
        glm::dvec3 to_middle{0.0};
        double min_along2 = 0.0;
    };

    const models::polygons::PolygonModel& model_;
    glm::dvec3 middle_m_{0.0};
    double radius_m_ = 1.0;
    std::vector<RayTarget> all_;
    std::vector<double> ball2_; ///< Of a ball around each target, a little larger: its radius squared.
    glm::dvec3 eye_{0.0};
    std::vector<FacingTarget> faced_;
};

/// Which eyes and polygons a ray test covers.
struct RayTestOptions {
    /// Whether parts with a pivot are looked at, at four angles. Without them, where no order can be right for them.
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
