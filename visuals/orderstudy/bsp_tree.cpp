// Binary space partition: H. Fuchs, Z. M. Kedem, B. F. Naylor, "On Visible Surface Generation by A Priori Tree
// Structures", SIGGRAPH 1980, with planes of the polygons themselves and a back-to-front walk.
//
// Deviations:
// - The plane of a node is the best of all by the number of cuts, not the best of a sample; of two
//   rules for equals the tree with the fewest cuts is kept.
// - Polygons in a node's plane that face the other way stay in the node. Each is painted on the way
//   through the node when the eye is on its side.
#include "visuals/orderstudy/bsp_tree.h"

#include "visuals/draworder/split.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <utility>

namespace octant::visuals::orderstudy {

namespace {

constexpr std::size_t max_candidates = 200; ///< At most this many planes are tried at a node.

using Polygons = std::vector<std::uint32_t>;

/// Where a polygon lies to a plane.
enum class Side { In, Front, Back, Both };

/// What decides among planes that cut equally many polygons.
enum class Among {
    Even,   ///< The numbers of polygons on both sides are most equal.
    Settled ///< The fewest polygons are left whose planes cut others on their side.
};

/// Builds one tree.
class BspTreeBuilder {
public:
    BspTreeBuilder(models::polygons::PolygonModel model, Among among)
        : tolerance_m_(draworder::split_tolerance_m(model)), among_(among) {
        tree_.model = std::move(model);
    }

    BspTree build() {
        const std::size_t polygons = tree_.model.polygons.size();
        Polygons all;
        for (std::uint32_t i = 0; i < polygons; ++i) { all.push_back(i); }
        std::vector<Task> tasks;
        tasks.push_back({std::move(all), BspTree::no_child, false, 1});
        while (!tasks.empty()) {
            const Task task = std::move(tasks.back());
            tasks.pop_back();
            add_node(task, tasks);
        }
        tree_.splits = static_cast<int>(tree_.model.polygons.size() - polygons);
        return std::move(tree_);
    }

private:
    /// The polygons that a new node below `parent` has to hold.
    struct Task {
        Polygons polygons;
        int parent = BspTree::no_child;
        bool in_front = false;
        int level = 1;
    };

    Side side_of(std::uint32_t polygon, const Plane& plane) const {
        bool front = false;
        bool back = false;
        for (const std::uint32_t vertex : tree_.model.corners(polygon)) {
            const double away_m = distance_m(plane, tree_.model.vertices_m[vertex]);
            front = front || away_m > tolerance_m_;
            back = back || away_m < -tolerance_m_;
        }
        if (front && back) { return Side::Both; }
        return front ? Side::Front : back ? Side::Back : Side::In;
    }

    /// The plane of polygon `cutter` cuts polygon `cut`; both are indices into the list of a task.
    struct Conflict {
        std::size_t cutter = 0;
        std::size_t cut = 0;
    };

    /// Where the polygons lie to the plane of one of them.
    std::vector<Side> sides_of(std::uint32_t cutter, const Polygons& polygons) const {
        const Plane plane = models::polygons::plane_of(tree_.model, cutter);
        std::vector<Side> sides;
        for (const std::uint32_t polygon : polygons) {
            sides.push_back(polygon == cutter ? Side::In : side_of(polygon, plane));
        }
        return sides;
    }

    /// All pairs in which the plane of one polygon cuts the other.
    std::vector<Conflict> conflicts_of(const Polygons& polygons) const {
        std::vector<Conflict> conflicts;
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            const std::vector<Side> sides = sides_of(polygons[i], polygons);
            for (std::size_t j = 0; j < sides.size(); ++j) {
                if (sides[j] == Side::Both) { conflicts.push_back({i, j}); }
            }
        }
        return conflicts;
    }

    /// The cost of a plane: the number of cuts, then what decides among equals; less is better.
    std::pair<int, int> cost_of(const std::vector<Side>& sides, const std::vector<Conflict>& conflicts) const {
        const auto count = [&](Side side) { return static_cast<int>(std::ranges::count(sides, side)); };
        const int cuts = count(Side::Both);
        if (among_ == Among::Even) { return {cuts, std::abs(count(Side::Front) - count(Side::Back))}; }
        const auto left = std::ranges::count_if(conflicts, [&](const Conflict& conflict) {
            const Side cutter = sides[conflict.cutter];
            const Side cut = sides[conflict.cut];
            return cutter != Side::In && cut != Side::In &&
                   (cutter == cut || cutter == Side::Both || cut == Side::Both);
        });
        return {cuts, static_cast<int>(left)};
    }

    /// The polygon whose plane costs least.
    std::uint32_t best_of(const Polygons& polygons) const {
        const std::size_t tried = std::min(polygons.size(), max_candidates);
        const std::vector<Conflict> conflicts =
            among_ == Among::Settled ? conflicts_of(polygons) : std::vector<Conflict>{};
        std::uint32_t best = polygons.front();
        std::pair<int, int> least = cost_of(sides_of(best, polygons), conflicts);
        for (std::size_t i = 1; i < tried; ++i) {
            const std::uint32_t polygon = polygons[i * polygons.size() / tried];
            const auto cost = cost_of(sides_of(polygon, polygons), conflicts);
            if (cost < least) {
                least = cost;
                best = polygon;
            }
        }
        return best;
    }

    /// Makes the node of a task and the tasks of its two sides.
    void add_node(const Task& task, std::vector<Task>& tasks) {
        const int number = static_cast<int>(tree_.nodes.size());
        if (task.parent != BspTree::no_child) {
            BspTree::Node& parent = tree_.nodes[static_cast<std::size_t>(task.parent)];
            (task.in_front ? parent.front : parent.back) = number;
        }
        tree_.depth = std::max(tree_.depth, task.level);
        BspTree::Node node;
        const std::uint32_t chosen = best_of(task.polygons);
        node.plane = models::polygons::plane_of(tree_.model, chosen);
        node.first = tree_.polygons.size();
        Task front{{}, number, true, task.level + 1};
        Task back{{}, number, false, task.level + 1};
        for (const std::uint32_t polygon : task.polygons) {
            const Side side = polygon == chosen ? Side::In : side_of(polygon, node.plane);
            if (side == Side::In) { add_to_plane(polygon, node.plane); }
            if (side == Side::Both) {
                back.polygons.push_back(draworder::split_polygon(tree_.model, polygon, node.plane));
            }
            if (side == Side::Front || side == Side::Both) { front.polygons.push_back(polygon); }
            if (side == Side::Back) { back.polygons.push_back(polygon); }
        }
        node.count = tree_.polygons.size() - node.first;
        tree_.nodes.push_back(node);
        for (Task& side : {std::ref(front), std::ref(back)}) {
            if (!side.polygons.empty()) { tasks.push_back(std::move(side)); }
        }
    }

    void add_to_plane(std::uint32_t polygon, const Plane& plane) {
        tree_.polygons.push_back(polygon);
        tree_.along.push_back(glm::dot(models::polygons::normal_of(tree_.model, polygon), plane.normal) > 0.0);
    }

    BspTree tree_;
    double tolerance_m_;
    Among among_;
};

} // namespace

BspTree bsp_tree(const models::polygons::PolygonModel& model) {
    BspTree even = BspTreeBuilder(model, Among::Even).build();
    BspTree settled = BspTreeBuilder(model, Among::Settled).build();
    return settled.splits < even.splits ? settled : even;
}

void append_painted(
    const BspTree& tree, const glm::dvec3& eye_m, std::vector<std::uint32_t>& painted, std::vector<int>& pending) {
    // An entry `node` means that the walk comes down to it; ~node means that its far side has been painted.
    pending.clear();
    if (!tree.nodes.empty()) { pending.push_back(0); }
    while (!pending.empty()) {
        const int entry = pending.back();
        pending.pop_back();
        const bool far_side_done = entry < 0;
        const int number = far_side_done ? ~entry : entry;
        const BspTree::Node& node = tree.nodes[static_cast<std::size_t>(number)];
        const bool in_front = distance_m(node.plane, eye_m) >= 0.0;
        if (!far_side_done) { pending.push_back(~number); }
        if (far_side_done) {
            for (std::size_t i = node.first; i < node.first + node.count; ++i) {
                if (tree.along[i] == in_front) { painted.push_back(tree.polygons[i]); }
            }
        }
        const int child = far_side_done == in_front ? node.front : node.back;
        if (child != BspTree::no_child) { pending.push_back(child); }
    }
}

} // namespace octant::visuals::orderstudy
