// The resolution C that spends a budget of triangles, exactly and in the frame it is spent.
//
// Source: equations (1) and (3) of E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that
// Minimize Flickering Effect", solved for C. The paper steers C by the triangles of earlier frames,
// equations (4) and (5); here the steps of N(C) themselves are collected and counted.
// Deviations: none; this takes the place of section 3.
#include "visuals/terrain/budget_survey.h"

#include "visuals/terrain/frustum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace octant::visuals::terrain {

/// Triangles of a fan that have an area: of each side without its mid-point and, with it, beside
/// its quadrants.
struct FanTriangles {
    std::array<int, 4> whole{1, 1, 1, 1};
    std::array<int, 4> a{1, 1, 1, 1};
    std::array<int, 4> b{1, 1, 1, 1};
    std::array<int, 4> of_quadrant{2, 2, 2, 2}; ///< those with mid-points
};

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

// How far a walk looks, as factors of C squared. They decide about time only.
constexpr float look_below = 0.7F;    ///< from the last frame's: steps are told apart from here
constexpr float look_above = 1.08F;   ///< from the last frame's: down to here
constexpr float first_look = 64.0F;   ///< without a last frame: C = 8
constexpr float step_back = 0.1F;     ///< after far too many triangles
constexpr float least_growth = 1.25F; ///< after too few
constexpr float most_growth = 8.0F;

constexpr FanTriangles all_triangles;

/// Those of a node at the field's north or east end.
FanTriangles triangles_with_area(const FanSamples& samples) {
    FanTriangles triangles;
    triangles.of_quadrant = {};
    const Sample centre = samples.at(1, 1);
    for (std::size_t k = 0; k < 4; ++k) {
        const FanEdge& edge = fan_edges[k];
        const Sample a = samples.corner_a(edge);
        const Sample b = samples.corner_b(edge);
        const Sample middle = samples.middle(edge);
        triangles.whole[k] = has_area(centre, a, b) ? 1 : 0;
        triangles.a[k] = has_area(centre, a, middle) ? 1 : 0;
        triangles.b[k] = has_area(centre, middle, b) ? 1 : 0;
        triangles.of_quadrant[edge.quadrant_a] += triangles.a[k];
        triangles.of_quadrant[edge.quadrant_b] += triangles.b[k];
    }
    return triangles;
}

/// All but the node's index.
GroundFan child_of(const GroundFan& fan, unsigned quadrant) {
    GroundFan child;
    child.column = static_cast<std::uint16_t>(2U * fan.column + (quadrant & 1U));
    child.row = static_cast<std::uint16_t>(2U * fan.row + (quadrant >> 1U));
    child.level = static_cast<std::uint8_t>(fan.level + 1);
    return child;
}

} // namespace

float BudgetSurvey::limit_for(const SplitRule& rule, const TriangleBudget& budget) {
    assert(budget.triangles >= 1);
    rule_ = &rule;
    nodes_tested_ = 0;
    const float least = rule.limit_squared(0.0);
    const float most = std::max(rule.limit_squared(budget.max_resolution), least);
    const float last = last_resolution_ > 0.0 ? rule.limit_squared(last_resolution_) : 0.0F;
    float low = std::clamp(last * look_below, least, most);
    float high = std::clamp(last > 0.0F ? last * look_above : first_look, least, most);
    float too_high = infinite;
    int most_triangles = 2 * budget.triangles + 1000;
    std::optional<float> found;
    while (!found) {
        most_triangles_ = high > least ? most_triangles : std::numeric_limits<int>::max();
        if (!survey(low, high)) {
            too_high = high;
            high = std::max(high * step_back, least);
            low = least;
            most_triangles += most_triangles / 4;
        } else if (low > least && steps_.most_below_low() > budget.triangles) {
            low = least;
        } else if (steps_.at_low() > budget.triangles) {
            found = least;
        } else if (const auto place = steps_.first_above(budget.triangles)) {
            found = *place;
        } else if (high >= most || !more_above_) {
            found = most;
        } else {
            const float missing = static_cast<float>(budget.triangles) /
                                  static_cast<float>(std::max(steps_.at_high(), 1));
            const float grown = high * std::clamp(1.1F * missing, least_growth, most_growth);
            high = std::min({grown, std::sqrt(high) * std::sqrt(too_high), most});
        }
    }
    last_resolution_ = rule.resolution_of(*found);
    return *found;
}

/// Walks the tree. False: stopped at too many triangles.
bool BudgetSurvey::survey(float low, float high) {
    nodes_.clear();
    steps_.start(low, high);
    high_ = high;
    more_above_ = false;
    Visit root;
    root.planes = planes_of(rule_->view().frustum_normals);
    visit(root);
    return steps_.at_high() <= most_triangles_;
}

void BudgetSurvey::visit(const Visit& from) {
    if (steps_.at_high() > most_triangles_) {
        return;
    }
    SurveyedNode node;
    node.fan = from.fan;
    node.fan.at_frustum = from.planes != 0;
    node.on = from.on;
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
    const FanTriangles* triangles = &all_triangles;
    if (samples.is_cut()) {
        cut_triangles = triangles_with_area(samples);
        triangles = &cut_triangles;
    }
    count(node, from.replaced, *triangles);
    nodes_.push_back(node);
    for (unsigned q = 0; q < 4; ++q) {
        if ((unsigned{node.fan.hidden} >> q & 1U) != 0) {
            continue;
        }
        if (node.split[q] >= high_) {
            more_above_ = true;
            continue;
        }
        Visit next = below(from, node, q);
        next.planes = planes[q];
        next.replaced = triangles->of_quadrant[q];
        visit(next);
    }
}

/// Fills in from where on the quadrants split, which of them are hidden, and the planes that their
/// boxes may reach beyond.
void BudgetSurvey::test_quadrants(
    const Visit& from, SurveyedNode& node, std::array<unsigned, 4>& planes) {
    const int level = from.fan.level + 1;
    const SplitRule::Level& at = rule_->level(level);
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
        node.split[q] = std::max(node.on, critical[q]);
        if (from.planes != 0) {
            child.node = rule_->node_at(level, child.column, child.row);
            planes[q] = rule_->planes_cutting_node(child, from.planes);
            node.fan.hidden |= planes[q] == outside_frustum ? bit : std::uint8_t{0};
        }
    }
}

/// Adds the steps of N(C) at which the node's fan appears and its mid-points do. That of a quadrant
/// which splits is the child's own.
void BudgetSurvey::count(const SurveyedNode& node, int replaced, const FanTriangles& triangles) {
    const auto unless_hidden = [&](unsigned quadrant, int some) {
        return (node.fan.hidden >> quadrant & 1U) == 0 ? some : 0;
    };
    int first = -replaced;
    for (std::size_t k = 0; k < 4; ++k) {
        const FanEdge& edge = fan_edges[k];
        const int with_middle = unless_hidden(edge.quadrant_a, triangles.a[k]) +
                                unless_hidden(edge.quadrant_b, triangles.b[k]);
        if (node.middle[k] <= node.on) {
            first += with_middle;
            continue;
        }
        first += triangles.whole[k];
        if (node.middle[k] < high_) {
            steps_.add(node.middle[k], with_middle - triangles.whole[k]);
        } else {
            more_above_ = true;
        }
    }
    steps_.add(node.on, first);
}

/// The visit to a child; planes and replaced triangles are the caller's to fill in.
BudgetSurvey::Visit
BudgetSurvey::below(const Visit& from, const SurveyedNode& node, unsigned quadrant) const {
    Visit next;
    next.fan = child_of(from.fan, quadrant);
    const int column = next.fan.column;
    const int row = next.fan.row;
    next.fan.node = rule_->node_at(next.fan.level, column, row);
    next.on = node.split[quadrant];
    const bool east = (quadrant & 1U) != 0;
    const bool north = (quadrant & 2U) != 0;
    const SplitRule::Level& at = rule_->level(next.fan.level);
    next.beyond[east ? 3 : 1] = east || column + 1 < at.columns ? node.split[quadrant ^ 1U] : 0.0F;
    next.beyond[north ? 0 : 2] = north || row + 1 < at.rows ? node.split[quadrant ^ 2U] : 0.0F;
    const std::size_t side = east ? 1 : 3;
    next.beyond[side] = on_beyond(from.beyond[side], next.fan.level, column + (east ? 1 : -1), row);
    const std::size_t end = north ? 2 : 0;
    next.beyond[end] = on_beyond(from.beyond[end], next.fan.level, column, row + (north ? 1 : -1));
    return next;
}

/// Limit above which a node is in the mesh or the field ends there; `parent`: its parent's.
float BudgetSurvey::on_beyond(float parent, int level, int column, int row) const {
    const SplitRule::Level& at = rule_->level(level);
    if (column < 0 || row < 0 || column >= at.columns || row >= at.rows) {
        return 0.0F;
    }
    if (parent >= high_) {
        return infinite;
    }
    return std::max(parent, rule_->critical_squared(level, column, row));
}

} // namespace octant::visuals::terrain
