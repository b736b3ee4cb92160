#pragma once

#include "models/polygons/polygon_model.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// A polygon of a model that rays may hit, in radii of the model about its middle.
struct RayTarget {
    std::uint32_t polygon = 0;
    bool two_sided = false;
    glm::dvec3 normal{0.0};
    glm::dvec3 middle{0.0};
    double radius = 0.0;
    std::vector<glm::dvec3> corners;
};

/// Where a ray hits a target.
struct RayHit {
    std::size_t target = 0; ///< Index into RayTargets::all().
    double distance = 0.0;  ///< From the eye.
    /// From the nearest side of the polygon.
    double edge_distance = 0.0;
    /// The change of `distance` when the target moves by ray_tolerance: large for a ray that grazes it.
    double distance_tolerance = 0.0;
    /// When the polygon is painted for the eye: 1 for the first one; 0: it is not painted.
    std::uint32_t painted = 0;
};

/// The polygons of a model at one angle of its turning parts, for tests of painting orders by rays: the polygon that is
/// painted last along a ray must be the nearest one.
class RayTargets {
public:
    /// In radii of the model. Tests skip rays that pass a side of a polygon by less, and differences of depth below it.
    /// A little more than the inset of occlusion tests (Tolerances).
    static constexpr double ray_tolerance = 3e-9;

    /// Polygons are hit from their fronts, those of `two_sided` from behind, too. Polygons
    /// without area are left out. Keeps a reference to the model. turn() must follow.
    explicit RayTargets(const models::polygons::PolygonModel& model, std::span<const std::uint32_t> two_sided = {});

    /// Turns the parts that have a pivot; leaves them out unless `turning_parts`.
    void turn(double turn_rad, bool turning_parts);

    const std::vector<RayTarget>& all() const { return all_; }

    /// The target of a polygon; null where it has none.
    const RayTarget* of(std::uint32_t polygon) const;

    glm::dvec3 in_model_m(const glm::dvec3& at) const { return middle_m_ + at * radius_m_; }

    glm::dvec3 in_radii(const glm::dvec3& at_m) const { return (at_m - middle_m_) / radius_m_; }

    double radius_m() const { return radius_m_; }

    /// Sets the eye of the rays that follow, in radii, until the parts are turned, and what is painted for it, first
    /// painted first.
    void set_eye(const glm::dvec3& eye, std::span<const std::uint32_t> painted);

    /// Replaces `hits` by all targets that a ray of unit length from the eye hits, in the order of all().
    void intersect(const glm::dvec3& ray, std::vector<RayHit>& hits) const;

private:
    /// A target that the eye sees. Most rays miss the ball around it, which is found out without the target: they do
    /// not pass its middle far enough along.
    struct FacingTarget {
        std::size_t target = 0;
        double height = 0.0; ///< Of the eye above the target's plane.
        glm::dvec3 to_middle{0.0};
        double min_along2 = 0.0;
    };

    const models::polygons::PolygonModel& model_;
    std::vector<bool> two_sided_; ///< By polygon.
    glm::dvec3 middle_m_{0.0};
    double radius_m_ = 1.0;
    std::vector<RayTarget> all_;
    std::vector<double> ball2_; ///< Of a ball around each target, a little larger: its radius squared.
    glm::dvec3 eye_{0.0};
    std::vector<FacingTarget> faced_;
    std::vector<std::uint32_t> painted_; ///< By polygon, as RayHit::painted.
};

} // namespace octant::visuals::draworder
