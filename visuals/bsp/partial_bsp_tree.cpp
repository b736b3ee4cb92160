// Binary space partition: H. Fuchs, Z. M. Kedem, B. F. Naylor, "On Visible Surface Generation by A
// Priori Tree Structures", SIGGRAPH 1980.
//
// Deviations:
// - Before a set is divided, what hides what for eyes anywhere is looked at (clusters.h). Only
//   rings of pieces are divided; a convex shell becomes one list without any cut.
// - Planes need not be those of polygons.
// - Polygons that lie in a node's plane stay in the node, in file order, those of either facing
//   apart.
#include "visuals/bsp/partial_bsp_tree.h"

#include "visuals/bsp/occlusion_components.h"
#include "visuals/bsp/splitting_plane.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace octant::visuals::bsp {

namespace {

/// Larger sets are divided before their graph is looked at, because its time is quadratic.
constexpr std::size_t max_samples_at_once = 1'500;
/// Sets of more pieces that came out of a ring are looked at only once they are a quarter of it.
constexpr std::size_t always_looked_at = 150;

using Items = std::vector<std::uint32_t>;

/// Builds one tree. Work that is left is kept in a stack of its own, because chains of partings may
/// be as long as there are polygons.
class PartialBspBuilder {
public:
    PartialBspBuilder(PolygonPieces& pieces, bool has_list_leaves)
        : pieces_(pieces)
        , by_clusters_(has_list_leaves) {}

    PartialBspTree build(Items items) {
        to_do_.push_back({std::move(items), -1, nullptr, 1, false});
        while (!to_do_.empty()) {
            Task task = std::move(to_do_.back());
            to_do_.pop_back();
            tree_.depth = std::max(tree_.depth, task.depth);
            const int child = child_of(task);
            if (task.parent < 0) {
                tree_.root = child;
            } else {
                tree_.nodes[static_cast<std::size_t>(task.parent)].*task.place = child;
            }
        }
        return std::move(tree_);
    }

private:
    using Node = PartialBspTree::Node;

    /// Pieces whose order has to be found, and the child of a node that it becomes.
    struct Task {
        Items items;
        int parent = -1;
        int Node::*place = nullptr;
        int depth = 1;
        bool is_ring = false; ///< One component, which has to be parted.
        /// How many pieces the last set had whose graph was looked at and out of which this came.
        std::size_t looked_at = std::numeric_limits<std::size_t>::max();
    };

    int child_of(Task& task) {
        if (task.items.empty()) {
            return PartialBspTree::nothing;
        }
        if (task.items.size() == 1) {
            return list_of(std::move(task.items));
        }
        const std::size_t count = task.items.size();
        const bool looks = by_clusters_ && !task.is_ring && count <= max_samples_at_once &&
                           (count <= always_looked_at || count <= task.looked_at / 4);
        if (!looks) {
            return choose_split(task);
        }
        task.looked_at = count;
        auto components = occlusion_components(pieces_, task.items);
        if (components.size() == 1 && components.front().size() > 1) {
            return choose_split(task);
        }
        return sequence_of(components, 0, components.size(), task.depth);
    }

    int list_of(Items items) {
        if (items.empty()) {
            return PartialBspTree::nothing;
        }
        tree_.lists.push_back(std::move(items));
        return ~static_cast<int>(tree_.lists.size() - 1);
    }

    int new_node(Node node) {
        tree_.nodes.push_back(std::move(node));
        return static_cast<int>(tree_.nodes.size() - 1);
    }

    /// Components from `first` to `end` painted one after the other. Depth grows with the logarithm
    /// of their number.
    int sequence_of(
        const std::vector<Items>& components, std::size_t first, std::size_t end, int depth) {
        const auto is_ring = [&](std::size_t i) { return components[i].size() > 1; };
        std::size_t ring = first;
        while (ring < end && !is_ring(ring)) {
            ++ring;
        }
        if (ring == end) {
            Items list;
            for (std::size_t i = first; i < end; ++i) {
                list.push_back(components[i].front());
            }
            return list_of(std::move(list));
        }
        const int node = new_node({});
        if (end - first == 1) { // a ring alone: nothing is painted before it
            to_do_.push_back(
                {components[first], node, &Node::back, depth + 1, true, components[first].size()});
            return node;
        }
        const std::size_t middle = divide_at(components, first, end);
        const int front = sequence_of(components, first, middle, depth + 1);
        const int back = sequence_of(components, middle, end, depth + 1);
        tree_.nodes[static_cast<std::size_t>(node)].front = front;
        tree_.nodes[static_cast<std::size_t>(node)].back = back;
        return node;
    }

    /// Where a sequence is divided: at an end of a run of single pieces near its middle.
    static std::size_t
    divide_at(const std::vector<Items>& components, std::size_t first, std::size_t end) {
        std::size_t middle = (first + end) / 2;
        const auto single = [&](std::size_t i) { return components[i].size() == 1; };
        while (middle > first + 1 && single(middle) && single(middle - 1)) {
            --middle;
        }
        if (middle == first + 1 && single(first) && single(middle)) {
            while (middle < end - 1 && single(middle)) {
                ++middle;
            }
        }
        return middle;
    }

    /// Divides pieces by a plane.
    int choose_split(Task& task) {
        const auto plane = splitting_plane(pieces_, task.items);
        if (!plane) {
            return unsplit_cycles(task);
        }
        Node node;
        node.plane = plane;
        Items front;
        Items back;
        Items coplanar_front;
        Items coplanar_back;
        for (const std::uint32_t item : task.items) {
            const PlaneSideFlags sides_reached = pieces_.sides_reached(item, *plane);
            if (sides_reached.before && sides_reached.behind) {
                back.push_back(pieces_.cut(item, *plane));
            }
            if (sides_reached.before) {
                front.push_back(item);
            } else if (sides_reached.behind) {
                back.push_back(item);
            } else {
                const auto& own = pieces_[item].plane; // a flat body is seen from both sides
                const double facing = own ? glm::dot(own->normal, plane->normal) : 0.0;
                if (facing >= 0.0) {
                    coplanar_front.push_back(item);
                }
                if (facing <= 0.0) {
                    coplanar_back.push_back(item);
                }
            }
        }
        node.coplanar_front = list_in_file_order(std::move(coplanar_front));
        node.coplanar_back = list_in_file_order(std::move(coplanar_back));
        const int made = new_node(node);
        to_do_.push_back(
            {std::move(front), made, &Node::front, task.depth + 1, false, task.looked_at});
        to_do_.push_back(
            {std::move(back), made, &Node::back, task.depth + 1, false, task.looked_at});
        return made;
    }

    /// The last resort: what stands still is parted, and what turns is painted over it.
    int unsplit_cycles(Task& task) {
        std::ranges::sort(task.items);
        tree_.unsplit_cycles.push_back(task.items);
        Items turning;
        Items fixed_pieces;
        for (const std::uint32_t item : task.items) {
            (pieces_[item].pivot ? turning : fixed_pieces).push_back(item);
        }
        if (fixed_pieces.empty() || turning.empty()) {
            return list_of(std::move(task.items));
        }
        const int node = new_node({});
        tree_.nodes.back().back = list_of(std::move(turning));
        to_do_.push_back({std::move(fixed_pieces), node, &Node::front, task.depth + 1, false});
        return node;
    }

    int list_in_file_order(Items items) {
        std::ranges::sort(
            items, {}, [&](std::uint32_t item) { return std::pair(pieces_[item].source, item); });
        return list_of(std::move(items));
    }

    PolygonPieces& pieces_;
    bool by_clusters_;
    std::vector<Task> to_do_;
    PartialBspTree tree_;
};

} // namespace

PartialBspTree partial_bsp_tree(PolygonPieces& pieces, std::vector<std::uint32_t> items, bool has_list_leaves) {
    return PartialBspBuilder(pieces, has_list_leaves).build(std::move(items));
}

} // namespace octant::visuals::bsp
