// The resolution C that spends a budget of triangles, exactly and in the frame in which it is
// spent: equations (1) and (3) of E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that
// Minimize Flickering Effect", solved for C. Each node has a critical C above which it is in the
// mesh; N(C) is a sum of steps at these values, and the largest C within the budget is read off.
//
// Deviation: this replaces section 3 of the paper, which steers C by the triangles of earlier
// frames, equations (4) and (5).
#include "visuals/terrain/quadtree_selection.h"

#include "visuals/terrain/fan_triangles.h"
#include "visuals/terrain/frustum.h"
#include "visuals/terrain/count_search.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace octant::visuals::terrain {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float first_look = 64.0F; ///< Without a last call the first walk looks up to C = 8.

/// A child of a node, without its index.
GroundFan child_of(const GroundFan& fan, unsigned quadrant) {
    GroundFan child;
    child.column = static_cast<std::uint16_t>(2U * fan.column + (quadrant & 1U));
    child.row = static_cast<std::uint16_t>(2U * fan.row + (quadrant >> 1U));
    child.level = static_cast<std::uint8_t>(fan.level + 1);
    return child;
}

} // namespace

float QuadtreeSelection::limit_for(const QuadtreeCriterion& rule, const TriangleBudget& budget) {
    assert(budget.triangles >= 1);
    rule_ = &rule;
    nodes_tested_ = 0;
    const float last = last_resolution_ > 0.0 ? rule.limit_squared(last_resolution_) : 0.0F;
    const CountSearch search{
        budget.triangles,
        rule.limit_squared(0.0),
        rule.limit_squared(budget.max_resolution),
        last,
        first_look};
    const float found =
        find_limit(search, steps_, [&](float low, float high, int max_triangles) {
            return survey(low, high, max_triangles);
        });
    last_resolution_ = rule.resolution_of(found);
    return found;
}

/// Walks the tree and collects nodes and steps below `high`. Returns whether there is more above
/// it.
bool QuadtreeSelection::survey(float low, float high, int max_triangles) {
    nodes_.clear();
    steps_.start(low, high);
    high_ = high;
    max_triangles_ = max_triangles;
    has_steps_above_ = false;
    PendingNode root;
    root.planes = active_planes(rule_->view().frustum_normals);
    visit(root);
    return has_steps_above_;
}

/// Surveys a node and the nodes below it.
void QuadtreeSelection::visit(const PendingNode& from) {
    if (steps_.at_high() > max_triangles_) {
        return;
    }
    SelectedNode node;
    node.fan = from.fan;
    node.fan.crosses_frustum = from.planes != 0;
    node.node_limit = from.node_limit;
    node.split.fill(infinite);
    std::array<unsigned, 4> planes{};
    if (from.fan.level + 1 < tree_->levels()) {
        test_quadrants(from, node, planes);
    }
    for (std::size_t k = 0; k < 4; ++k) {
        const FanEdge& edge = fan_edges[k];
        node.middle[k] =
            std::min({from.beyond[k], node.split[edge.quadrant_a], node.split[edge.quadrant_b]});
    }
    const FanSamples samples(
        tree_->field(), rule_->level(node.fan.level).edge, node.fan.column, node.fan.row);
    FanTriangles cut_triangles;
    const FanTriangles* triangles = &uncut_fan_triangles;
    if (samples.is_cut()) {
        cut_triangles = triangles_with_area(samples);
        triangles = &cut_triangles;
    }
    const FanLimits limits{node.node_limit, node.middle, node.fan.hidden, from.replaced};
    has_steps_above_ = count_fan(limits, *triangles, high_, steps_) || has_steps_above_;
    nodes_.push_back(node);
    for (unsigned q = 0; q < 4; ++q) {
        if ((unsigned{node.fan.hidden} >> q & 1U) != 0) {
            continue;
        }
        if (node.split[q] >= high_) {
            has_steps_above_ = true;
            continue;
        }
        PendingNode next = child_pending(from, node, q);
        next.planes = planes[q];
        next.replaced = triangles->of_quadrant[q];
        visit(next);
    }
}

/// Fills in the limits at which the quadrants split, which of them are hidden, and which frustum
/// planes their boxes may reach beyond.
void QuadtreeSelection::test_quadrants(
    const PendingNode& from, SelectedNode& node, std::array<unsigned, 4>& planes) {
    const int level = from.fan.level + 1;
    const QuadtreeCriterion::Level& at = rule_->level(level);
    const std::array<float, 4> critical =
        rule_->critical_squared_of_four(level, 2 * from.fan.column, 2 * from.fan.row);
    for (unsigned q = 0; q < 4; ++q) {
        const auto bit = static_cast<std::uint8_t>(1U << q);
        GroundFan child = child_of(from.fan, q);
        if (child.column >= at.columns || child.row >= at.rows) {
            node.fan.hidden |= bit;
            continue;
        }
        ++nodes_tested_;
        node.split[q] = std::max(node.node_limit, critical[q]);
        if (from.planes != 0) {
            child.node = rule_->node_at(level, child.column, child.row);
            planes[q] = rule_->crossed_planes_of_node(child, from.planes);
            node.fan.hidden |= planes[q] == outside_frustum ? bit : std::uint8_t{0};
        }
    }
}

/// The visit to a child; planes and replaced triangles are left to the caller.
QuadtreeSelection::PendingNode
QuadtreeSelection::child_pending(const PendingNode& from, const SelectedNode& node, unsigned quadrant) const {
    PendingNode next;
    next.fan = child_of(from.fan, quadrant);
    const int column = next.fan.column;
    const int row = next.fan.row;
    next.fan.node = rule_->node_at(next.fan.level, column, row);
    next.node_limit = node.split[quadrant];
    const bool east = (quadrant & 1U) != 0;
    const bool north = (quadrant & 2U) != 0;
    const QuadtreeCriterion::Level& at = rule_->level(next.fan.level);
    next.beyond[east ? 3 : 1] = east || column + 1 < at.columns ? node.split[quadrant ^ 1U] : 0.0F;
    next.beyond[north ? 0 : 2] = north || row + 1 < at.rows ? node.split[quadrant ^ 2U] : 0.0F;
    const std::size_t side = east ? 1 : 3;
    next.beyond[side] = neighbour_limit(from.beyond[side], next.fan.level, column + (east ? 1 : -1), row);
    const std::size_t end = north ? 2 : 0;
    next.beyond[end] = neighbour_limit(from.beyond[end], next.fan.level, column, row + (north ? 1 : -1));
    return next;
}

/// The limit above which a neighbouring node is in the mesh; 0 where the field ends there. `parent`
/// is the limit of that node's parent.
float QuadtreeSelection::neighbour_limit(float parent, int level, int column, int row) const {
    const QuadtreeCriterion::Level& at = rule_->level(level);
    if (column < 0 || row < 0 || column >= at.columns || row >= at.rows) {
        return 0.0F;
    }
    if (parent >= high_) {
        return infinite;
    }
    return std::max(parent, rule_->critical_squared(level, column, row));
}

} // namespace octant::visuals::terrain
