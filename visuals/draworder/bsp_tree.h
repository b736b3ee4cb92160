#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::draworder {

/// A binary space partition of a model by planes of its own polygons, to compare other orders with:
/// it orders every model for every eye, cuts polygons where it must and is walked through anew in
/// every frame, one plane test a node. Parts with a pivot stay at the file's angle.
struct BspTree {
    static constexpr int nothing = -1;

    /// Polygons first .. first + count - 1 of `polygons` lie in the plane, facing either way.
    struct Node {
        Plane plane;
        int front = nothing; ///< another node, on the side where the normal points
        int back = nothing;
        std::size_t first = 0;
        std::size_t count = 0;
    };

    models::polygons::PolygonModel model; ///< with the pieces; parents say of what
    std::vector<Node> nodes;              ///< node 0 is the root; children are later nodes
    std::vector<std::uint32_t> polygons;  ///< each polygon of `model` once, node after node
    std::vector<bool> along; ///< whether polygons[i] faces where its node's normal does
    int splits = 0;          ///< polygons added by cutting
    int depth = 0;           ///< nodes on the longest way from the root
};

/// Builds a tree. At each node the plane is taken that cuts the fewest polygons; all polygons there
/// are tried, or 200 spread evenly over them where there are more. Among equals it is the one that
/// leaves the two sides nearest in number, or the one that leaves the fewest polygons whose planes
/// cut others: of these two trees the one with fewer cuts. The time grows with the square of the
/// polygons at least.
BspTree bsp_tree(const models::polygons::PolygonModel& model);

/// The polygons that face an eye, first painted first, appended to `painted`. Takes no memory once
/// both vectors have grown; `to_do` is working space.
void append_painted(
    const BspTree& tree,
    const glm::dvec3& eye_m,
    std::vector<std::uint32_t>& painted,
    std::vector<int>& to_do);

} // namespace octant::visuals::draworder
