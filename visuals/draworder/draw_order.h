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
/// of eye space a range of that list. Cells with equal lists share a range. At run time an eye
/// needs a few plane tests and no sorting.
class DrawOrder {
public:
    /// Polygons first to first + count - 1 of the flat list.
    struct Range {
        std::size_t first = 0;
        std::size_t count = 0;
        bool operator==(const Range&) const = default;
    };

    /// A plane that divides eye space in two. A child >= 0 is another node, a child < 0 is the cell
    /// ~child.
    struct Node {
        Plane plane;
        int front = 0; ///< The child where dot(normal, eye) + offset >= 0.
        int back = 0;
    };

    /// The paper's eight cells, the octants.
    explicit DrawOrder(const OctantOrders& orders);

    /// Cells below a tree of planes with node 0 as its root; without nodes there is a single cell.
    /// lists[i] is the list of cell i, first painted first. Every child must be a later node or a
    /// cell (asserted).
    DrawOrder(std::vector<Node> nodes, std::span<const std::vector<std::uint32_t>> lists);

    /// A single cell: the same list for every eye, first painted first.
    explicit DrawOrder(std::vector<std::uint32_t> list);

    int cell_count() const { return static_cast<int>(cells_.size()); }

    /// How many different lists there are.
    int list_count() const { return list_count_; }

    std::span<const Node> nodes() const { return nodes_; }

    /// The cell in which an eye (body axes, metres) lies, 0 to cell_count - 1. Every eye lies in
    /// one.
    int cell_of(const glm::dvec3& eye_in_body_m) const;

    /// The range of a cell's list in polygons().
    Range range_of(int cell) const;

    /// A cell's list, first painted first.
    std::span<const std::uint32_t> polygons_of(int cell) const;

    /// All different lists one after the other, in the order of the first cells that use them.
    std::span<const std::uint32_t> polygons() const { return polygons_; }

private:
    /// Adds a cell; an equal list that is there already is shared.
    void add_cell(std::span<const std::uint32_t> list);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> polygons_;
    std::vector<Range> cells_;
    int list_count_ = 0;
};

/// A single cell that lists all polygons in file order: for painting with a depth buffer, and for
/// models whose file order is a painting order.
DrawOrder file_order(const models::polygons::PolygonModel& model);

} // namespace octant::visuals::draworder
