#pragma once

#include "visuals/draworder/eye_region.h"
#include "visuals/draworder/face.h"

#include <glm/vec4.hpp>

#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Whether one face hides part of another for some eye of a region: the test on which every order
/// of a tree or of cells rests. Reuses its storage.
///
/// Let A and B be convex planar faces, seen from their fronts only, and R the region cut to both
/// fronts. An eye e of R sees a point a of A through the point of plane(B) where the segment a-e
/// crosses it; B hides a from e if and only if that point lies in B. Only points a behind plane(B)
/// count, since e is in front of it; A- is what A has there. The union of all segments between two
/// convex sets is the convex hull of both, so all crossings together are the convex set
///     C = conv(A- u R) cut by plane(B),
/// and B hides part of A for some eye of R if and only if the interiors of B and C overlap. (R has
/// volume, so C has an interior, and a point of it belongs to an eye inside R.)
///
/// C is the hull of the crossings of the segments between corners of A- (all behind the plane) and
/// generators of R (none behind it). For a corner a at height -s and a generator g = (x, y, z, w)
/// at height t the crossing is t * (a, 1) + s * g, in homogeneous coordinates; with w = 0 and t = 0
/// it is a point at infinity of the plane, and nothing special.
///
/// B and C are disjoint if and only if some line separates them weakly. It can be pushed towards B
/// until it runs through a corner b of B. For a given b there is one if and only if the
/// directions from b to its two neighbours, turned about, and the directions from b to all of C lie
/// in one half-plane. The direction from b to a homogeneous point (p, w) is p - w * b.
class HidingTest {
public:
    explicit HidingTest(const Tolerances& tolerances)
        : tolerances_(tolerances) {}

    /// What can be said without a region: false when B lies nowhere in front of A's plane or A
    /// nowhere behind B's.
    bool possible(const Face& b, const Face& a) const;

    /// Whether B hides part of A for some eye of the region that `eyes` generates (as
    /// EyeRegion::append_generators gives them). The region lies in front of the planes of both,
    /// where they have planes. A body on either side asks for a plane between the convex hull of A
    /// and the eyes, and B (convex_separation.h). A single eye may be given as (x, y, z, 1).
    bool hides(const Face& b, const Face& a, std::span<const glm::dvec4> eyes);

private:
    void find_crossings(const Face& b, const Face& a, std::span<const glm::dvec4> eyes);
    bool apart_at(const Face& b, std::size_t corner) const;

    Tolerances tolerances_;
    std::vector<glm::dvec4> behind_;    ///< corners of A-, height in w
    std::vector<glm::dvec3> crossings_; ///< generators of C, homogeneous in b's axes
};

} // namespace octant::visuals::draworder
