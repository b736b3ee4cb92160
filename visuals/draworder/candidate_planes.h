#pragma once

#include "sim/base/plane.h"
#include "visuals/draworder/model_faces.h"
#include "visuals/draworder/occlusion_graph_builder.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Planes perpendicular to a coordinate axis through the corners of the polygons `among`, those of x before y before z:
/// about `most` of them, spread evenly over all that there are.
std::vector<Plane> axis_planes(const ModelFaces& model, std::span<const std::uint32_t> among, std::size_t most);

/// Planes by which eye space may be cut so that the hiding relation among some polygons gets simpler, each once, the
/// plainest first: the polygons' own planes, and planes through an edge of one polygon and a corner of another. The
/// last kind includes all that bound the region from where one polygon hides another, so that cutting by them resolves
/// every pair in the end. About `most` of them are made, spread evenly over all that there are. A model that is turned
/// gets the same planes, turned.
std::vector<Plane> candidate_planes(const ModelFaces& model, std::span<const std::uint32_t> among, std::size_t most);

/// Where a face lies to a plane. Both are true when it lies in the plane, and neither when it straddles it.
struct PlaneSide {
    bool before = false;
    bool behind = false;
};

/// Where a face lies to a plane, with `on_plane` as the tolerance.
PlaneSide side_of(const Plane& plane, const Face& face, double on_plane);

/// Where polygons lie to a plane that cuts a region of eyes, and for each side of it those polygons that lie in the
/// plane and face away from all eyes there.
struct PolygonsByPlaneSide {
    explicit PolygonsByPlaneSide(std::size_t count)
        : sets{PolygonSet(count), PolygonSet(count)}, back_facing_in_front(count), back_facing_behind(count) {}

    PlaneSideSets sets;
    PolygonSet back_facing_in_front;
    PolygonSet back_facing_behind;
};

/// Where the polygons `among` lie to a plane.
PolygonsByPlaneSide sides_of(const Plane& plane, const ModelFaces& model, std::span<const std::uint32_t> among);

} // namespace octant::visuals::draworder
