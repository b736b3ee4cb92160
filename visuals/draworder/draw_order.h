#pragma once

#include "sim/base/plane.h"
#include "visuals/draworder/octant_order.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// Painting orders as a renderer uploads them: one flat list of polygon numbers, and a tree that says for each eye
/// which ranges of it are painted one after the other. At run time an eye needs plane tests and no sorting. Three kinds
/// of nodes:
/// - a view split divides eye space by a plane: only the child on the eye's side is painted;
/// - a polygon split divides the polygons by a plane, as a node of a BSP tree does: first the polygons on the far side
///   from the eye are painted, then those in the plane that face the eye, then those on the eye's side;
/// - a sequence paints two parts one after the other, for every eye.
/// The leaves are cells with a list each. Where all nodes are view splits, each eye lies in one cell, and its list is
/// one range.
class DrawOrder {
public:
    /// Polygons first to first + count - 1 of the flat list.
    struct Range {
        std::size_t first = 0;
        std::size_t count = 0;
        bool operator==(const Range&) const = default;
    };

    enum class Kind { ViewSplit, PolygonSplit, Sequence };

    /// A child where nothing is painted.
    static constexpr int no_child = std::numeric_limits<int>::min();

    /// A child >= 0 is another node, a child < 0 is the cell ~child or no_child.
    struct Node {
        Plane plane;   ///< Not of a sequence.
        int front = 0; ///< Where dot(normal, .) + offset >= 0; of a sequence the child that is painted first.
        int back = 0;  ///< The other one.
        Kind kind = Kind::ViewSplit;
        /// Of a polygon split: the cells of the polygons in the plane that face its front and its back.
        int coplanar_front = no_child;
        int coplanar_back = no_child;
    };

    /// The ranges that an eye paints, and memory that is used on the way to them.
    struct Walk {
        std::vector<Range> ranges;
        std::vector<int> pending;
    };

    /// The paper's eight cells, the octants.
    explicit DrawOrder(const OctantOrders& orders);

    /// Cells below a tree with node 0 as its root; without nodes there is a single cell. lists[i] is the list of cell
    /// i, first painted first. Every child must be a later node, a cell or no_child (asserted).
    DrawOrder(std::vector<Node> nodes, std::span<const std::vector<std::uint32_t>> lists);

    /// A single cell: the same list for every eye, first painted first.
    explicit DrawOrder(std::vector<std::uint32_t> list);

    /// Replaces the plane of each node.
    template <typename Convert>
    void convert_planes(Convert convert) {
        for (Node& node : nodes_) {
            if (node.kind != Kind::Sequence) { node.plane = convert(node.plane); }
        }
    }

    int cell_count() const { return static_cast<int>(cells_.size()); }

    /// How many different lists there are.
    int list_count() const { return list_count_; }

    std::span<const Node> nodes() const { return nodes_; }

    /// Whether all nodes are view splits, so that every eye lies in one cell.
    bool has_one_cell_per_eye() const { return has_one_cell_per_eye_; }

    /// The cell in which an eye (body axes, metres) lies, 0 to cell_count - 1. Every eye must lie in one
    /// (has_one_cell_per_eye, asserted).
    int cell_of(const glm::dvec3& eye_in_body_m) const;

    /// What is painted for an eye (body axes, metres), first painted first: consecutive ranges of polygons(), joined
    /// where one goes on where the other ends. They stay until the next call with the same memory; nothing is allocated
    /// once that has grown.
    std::span<const Range> ranges_of(const glm::dvec3& eye_in_body_m, Walk& walk) const;

    /// Appends the polygons that are painted for an eye, first painted first.
    void append_painted(const glm::dvec3& eye_in_body_m, Walk& walk, std::vector<std::uint32_t>& painted) const;

    /// The range of a cell's list in polygons().
    Range range_of(int cell) const;

    /// A cell's list, first painted first.
    std::span<const std::uint32_t> polygons_of(int cell) const;

    /// All different lists one after the other, in the order of the first cells that use them.
    std::span<const std::uint32_t> polygons() const { return polygons_; }

private:
    /// Adds all cells; equal lists are shared.
    void add_cells(std::span<const std::vector<std::uint32_t>> lists);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> polygons_;
    std::vector<Range> cells_;
    int list_count_ = 0;
    bool has_one_cell_per_eye_ = true;
};

/// The eye points that share a list.
struct OrderCell {
    std::string path; ///< Paper, Cells: "+-+/0/3"; empty for a cell of a tree.
    /// The cell is the intersection of the half-spaces in front of them; unit normals, body axes.
    std::vector<Plane> planes;
};

/// A single cell that lists all polygons in file order: for painting with a depth buffer, and for models whose file
/// order is a painting order.
DrawOrder file_order(const models::polygons::PolygonModel& model);

} // namespace octant::visuals::draworder
