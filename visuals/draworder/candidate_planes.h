#pragma once

#include "sim/base/plane.h"
#include "visuals/draworder/model_faces.h"
#include "visuals/draworder/region_graph.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Planes across a coordinate axis through a corner of one of some polygons, x before y before z;
/// about `most` of them, evenly spread over all there are.
std::vector<Plane>
axis_planes(const ModelFaces& model, std::span<const std::uint32_t> among, std::size_t most);

/// Planes by which eye space may be cut so that the pairs among some polygons fall apart, each
/// once, the plainest first: axis planes, planes of the
/// polygons, and planes through an edge and a corner. The last are all that bound the region from
/// where one of the polygons hides another, so that cutting by them ends every pair in time.
/// Of these no more than about `most` are made, evenly spread over all there are.
std::vector<Plane>
candidate_planes(const ModelFaces& model, std::span<const std::uint32_t> among, std::size_t most);

/// How a face lies to a plane: both when it lies on it, neither when it straddles it.
struct FaceSide {
    bool before = false;
    bool behind = false;
};

FaceSide side_of(const Plane& plane, const Face& face, double on_plane);

/// How polygons lie to a plane. For each side of it the polygons that no eye there can face.
struct PlaneSides {
    explicit PlaneSides(std::size_t count)
        : sets{PolygonSet(count), PolygonSet(count)}
        , unseen_in_front(count)
        , unseen_behind(count) {}

    SideSets sets;
    PolygonSet unseen_in_front;
    PolygonSet unseen_behind;
};

/// Of the polygons `among`.
PlaneSides
sides_of(const Plane& plane, const ModelFaces& model, std::span<const std::uint32_t> among);

} // namespace octant::visuals::draworder
