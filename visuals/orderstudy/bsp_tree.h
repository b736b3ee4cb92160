#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::orderstudy {

/// A binary space partition of a model by planes of its own polygons, to compare the other orders with. It orders any
/// model for any eye, but it cuts polygons where it must and is walked anew in every frame, with one plane test at each
/// node. Parts with a pivot stay at the angle that the file shows. Body axes, metres.
struct BspTree {
    static constexpr int no_child = -1;

    /// A plane of the tree. Polygons first to first + count - 1 of `polygons` lie in it, facing either way.
    struct Node {
        Plane plane;
        int front = no_child; ///< The child on the side to which the normal points.
        int back = no_child;
        std::size_t first = 0;
        std::size_t count = 0;
    };

    /// The model with cut polygons; its parents hold the polygon of which each is a piece.
    models::polygons::PolygonModel model;
    std::vector<Node> nodes;             ///< Node 0 is the root; children come after their parents.
    std::vector<std::uint32_t> polygons; ///< Each polygon of `model` once, node after node.
    /// For each entry of `polygons` whether it faces as its node's normal does.
    std::vector<bool> along;
    int splits = 0; ///< How many polygons were added by cutting.
    int depth = 0;  ///< The number of nodes on the longest path from the root.
};

/// Builds a tree. At each node the plane that cuts the fewest polygons is taken; all polygons there are candidates, or
/// 200 spread evenly over them where there are more. Two trees are built, which differ in what decides among equals:
/// the plane that divides the polygons most evenly, or the one that leaves the fewest polygons whose planes cut others.
/// The tree with fewer cuts is returned. The time grows at least with the square of the number of polygons.
BspTree bsp_tree(const models::polygons::PolygonModel& model);

/// Appends the polygons that face an eye to `painted`, first painted first. `pending` is scratch memory; nothing is
/// allocated once both vectors have grown.
void append_painted(
    const BspTree& tree, const glm::dvec3& eye_m, std::vector<std::uint32_t>& painted, std::vector<int>& pending);

} // namespace octant::visuals::orderstudy
