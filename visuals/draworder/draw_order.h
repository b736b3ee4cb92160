#pragma once

#include "sim/base/plane.h"
#include "visuals/draworder/octant_order.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Painting orders as a renderer uploads them: one flat list of polygon numbers, and for each cell
/// of eye space a range of it. Cells with equal lists share a range.
class DrawOrder {
public:
    /// Polygons first .. first + count - 1 of the flat list.
    struct Range {
        std::size_t first = 0;
        std::size_t count = 0;
        bool operator==(const Range&) const = default;
    };

    /// A plane that parts eye space. A child >= 0 is another node, a child < 0 is cell ~child.
    struct Node {
        Plane plane;
        int front = 0; ///< where dot(normal, eye) + offset >= 0
        int back = 0;
    };

    /// Eight cells, the octants.
    explicit DrawOrder(const OctantOrders& orders);

    /// Cells under a tree of planes, node 0 first; without nodes one cell. lists[i] is cell i,
    /// first painted first. Every child is a later node or a cell (asserted).
    DrawOrder(std::vector<Node> nodes, std::span<const std::vector<std::uint32_t>> lists);

    /// One cell: the same list for every eye, first painted first.
    explicit DrawOrder(std::vector<std::uint32_t> list);

    int cell_count() const { return static_cast<int>(cells_.size()); }

    /// How many different lists the cells share.
    int list_count() const { return list_count_; }

    std::span<const Node> nodes() const { return nodes_; }

    /// The cell in which an eye (body axes) lies, 0 .. cell_count - 1; every eye lies in one.
    int cell_of(const glm::dvec3& eye_in_body_m) const;

    /// Where a cell's list lies in polygons().
    Range range_of(int cell) const;

    /// A cell's list, first painted first.
    std::span<const std::uint32_t> polygons_of(int cell) const;

    /// All different lists, one after the other, in the order of the first cell that uses each.
    std::span<const std::uint32_t> polygons() const { return polygons_; }

private:
    void add_cell(std::span<const std::uint32_t> list);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> polygons_;
    std::vector<Range> cells_;
    int list_count_ = 0;
};

/// One cell that lists all polygons in file order: for painting with a depth buffer, and for models
/// whose file order is their painting order.
DrawOrder file_order(const models::polygons::PolygonModel& model);

} // namespace octant::visuals::draworder
