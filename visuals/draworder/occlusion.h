#pragma once

#include "visuals/draworder/face.h"
#include "visuals/draworder/view_region.h"

#include <glm/vec4.hpp>

#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Whether one face hides part of another for some eye of a region: the exact test on which the orders of trees and
/// cells rest. Its memory is reused.
///
/// Let A and B be convex planar faces that are seen from their fronts only, and R the region of eyes cut to the fronts
/// of both. An eye e of R sees a point a of A through the point of plane(B) where the segment from a to e crosses it; B
/// hides a from e if and only if that point lies in B. Only points a behind plane(B) count, because e is in front of
/// it; A- is the part of A there. The union of all segments between two convex sets is their convex hull, so all
/// crossings together are the convex set
///     C = conv(A- u R) cut by plane(B),
/// and B hides part of A for some eye of R if and only if the interiors of B and C overlap. (R has a volume, so C has
/// an interior, and a point of it belongs to an eye inside R.)
///
/// C is the hull of the crossings of the segments between corners of A- (all behind the plane) and generators of R
/// (none behind it). For a corner a at height -s and a generator g = (x, y, z, w) at height t the crossing is t * (a,
/// 1) + s * g in homogeneous coordinates. With w = 0 and t = 0 it is a point at infinity of the plane, which needs no
/// special treatment.
///
/// B and C are disjoint if and only if some line separates them weakly. It can be pushed towards B until it passes
/// through a corner b of B. For a given b there is such a line if and only if the reversed directions from b to its two
/// neighbours, and the directions from b to all of C, lie in one half-plane. The direction from b to a homogeneous
/// point (p, w) is p - w * b.
class OcclusionTest {
public:
    explicit OcclusionTest(const Tolerances& tolerances) : tolerances_(tolerances) {}

    /// A quick test without a region. Returns false when B is nowhere in front of A's plane or A nowhere behind B's, so
    /// that B can never hide part of A.
    bool possible(const Face& b, const Face& a) const;

    /// Whether B hides part of A for some eye of the region that `eyes` generates (see ViewRegion::append_generators).
    /// The region must lie in front of the planes of both faces, where they have planes. If one of them is a body, the
    /// question is whether no plane separates B from the convex hull of A and the eyes (convex_separation.h). A single
    /// eye is given as (x, y, z, 1).
    bool occludes(const Face& b, const Face& a, std::span<const glm::dvec4> eyes);

private:
    /// Fills crossings_ with generators of C.
    void find_crossings(const Face& b, const Face& a, std::span<const glm::dvec4> eyes);
    /// Whether a line through a corner of `b` has `b` on one side and C on the other.
    bool is_separated_at(const Face& b, std::size_t corner) const;

    Tolerances tolerances_;
    /// The corners of A- in the coordinates of b's plane, and how far each is behind it.
    std::vector<glm::dvec3> behind_;
    /// Generators of C, homogeneous, in the coordinates of b's plane.
    std::vector<glm::dvec3> crossings_;
};

} // namespace octant::visuals::draworder
