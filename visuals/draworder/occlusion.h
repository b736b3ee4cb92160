#pragma once

#include "models/planar/planar_model.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"
#include "visuals/draworder/occlusion_graph.h"
#include "visuals/draworder/view_region.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// The shape that occlusion tests use for a polygon: its outline, shrunk a little so that polygons which only touch do
/// not occlude one another, or the body that a turning polygon sweeps (swept_face). Lengths are in the unit of
/// ViewRegion.
struct Face {
    /// Before shrinking; in order around an outline, in any order for a body.
    std::vector<glm::dvec3> outline;
    std::vector<glm::dvec3> corners; ///< After shrinking.
    /// The plane of an outline, its front where it is seen from; a body has none.
    std::optional<Plane> plane;
    /// The corners in the coordinates (right, up), counter-clockwise.
    std::vector<glm::dvec2> flat;
    std::vector<glm::dvec2> edge_directions; ///< The unit directions from each of them to the next one.
    glm::dvec3 right{0.0};
    glm::dvec3 up{0.0};                 ///< Equal to cross(normal, right).
    std::optional<std::uint32_t> pivot; ///< The index in PolygonModel::pivots of the pivot that turns it.
};

/// Tolerances of occlusion tests, in the unit of ViewRegion.
struct Tolerances {
    /// Outlines are shrunk by this distance.
    double inset = models::planar::planar_tolerance;
    /// A point within this distance of a plane counts as on it.
    double on_plane = inset / 10.0;
};

/// The face of a convex outline that lies in `plane` but for rounding. Its corners are projected onto the plane, and
/// every edge is moved inwards by the inset, but by no more than a fifth of the least distance between a corner and the
/// centroid.
Face outline_face(std::span<const glm::dvec3> corners, const Plane& plane, double inset);

/// The part of a convex outline in front of a plane that it straddles. Corners within `on_plane` of the plane belong to
/// it as they are, so that no two corners lie closer together than those of the outline.
std::vector<glm::dvec3> front_part(const std::vector<glm::dvec3>& outline, const Plane& plane, double on_plane);

/// Whether two outlines that face the same way lie in one plane, within `on_plane`, and overlap there. False for
/// polygons that turn.
bool overlap_in_plane(const Face& a, const Face& b, double on_plane);

/// A model prepared for occlusion tests: face i stands for polygon i. The unit of length is the model's radius about
/// `origin_m`, which is the origin; axes are the body's.
struct ModelFaces {
    std::vector<Face> faces;
    Tolerances tolerances;
    glm::dvec3 origin_m{0.0};
    double unit_m = 1.0;
    /// Edges within turning parts, whose polygons keep their places to each other, and from each polygon to later ones
    /// that overlap it in its plane. They hold for every eye and have no cycles.
    OcclusionGraph rigid;
    /// Pairs that collide as they turn, in both directions; no order can be right for them.
    OcclusionGraph ignored;
    /// Messages about turning parts whose polygons no order paints correctly.
    std::vector<std::string> notes;

    /// Converts a plane of the faces' space to body axes, metres.
    Plane in_model(const Plane& plane) const;

    /// Converts a plane in body axes to the faces' space.
    Plane to_face_space(const Plane& plane) const;
};

/// Prepares a planar model (models/planar/planar_model.h). Outlines are shrunk by planar_tolerance times the radius.
ModelFaces model_faces(const models::polygons::PolygonModel& model, const glm::dvec3& origin_m);

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

/// The polygons on each side of a plane that cuts a region, as seen from one of its sides.
struct PlaneSideSets {
    BitSet front_or_on;
    BitSet back_or_on;
};

/// Builds the occlusion graphs of a model's faces over regions of eye space. Keeps a reference to the faces; its memory
/// is reused.
class OcclusionGraphBuilder {
public:
    explicit OcclusionGraphBuilder(const ModelFaces& faces) : faces_(faces), test_(faces.tolerances) {}

    const ModelFaces& model() const { return faces_; }

    /// The graph of all pairs for all eyes of a region. Pairs that collide as they turn are left out.
    OcclusionGraph all(const ViewRegion& region);

    /// Those edges of `parent`, the graph of a larger region, that remain in this region, for the rows `among`. Nothing
    /// else needs a test, because a polygon that hides nothing of another for any eye of a region does not do so for a
    /// part of it.
    OcclusionGraph surviving(
        const ViewRegion& region, const OcclusionGraph& parent, std::span<const std::uint32_t> among);

    /// The edges of `parent` that remain in front of a plane, judged only by the sides on which polygons lie: a polygon
    /// behind the plane or in it occludes none in front of it or in it. For the rows `among`.
    OcclusionGraph remaining_in_front(
        const OcclusionGraph& parent, std::span<const std::uint32_t> among, const PlaneSideSets& sides) const;

    /// The edges of `parent` that remain for a single eye, for the rows `among`.
    OcclusionGraph at_eye(const glm::dvec3& eye, const OcclusionGraph& parent, std::span<const std::uint32_t> among);

    /// The polygons that face some eye of a region.
    BitSet listed(const ViewRegion& region) const;

private:
    /// Prepares occludes() for a region and a face `a`: cuts the region to the front of `a`. Returns false when nothing
    /// is left, so that no eye sees `a`.
    bool clip_to_front(const ViewRegion& region, const Face& a);
    /// Whether `b` hides part of `a` for some eye of the prepared region.
    bool occludes(std::size_t b, std::size_t a);

    const ModelFaces& faces_;
    OcclusionTest test_;
    /// The part of the region that sees face `a` from its front.
    std::optional<ViewRegion> region_in_front_of_a_;
    std::vector<glm::dvec4> generators_of_a_;
    std::vector<glm::dvec4> generators_;
};

} // namespace octant::visuals::draworder
