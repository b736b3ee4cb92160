// The smallest screen-space error that keeps a budget of triangles, exactly and in the same frame. It has no source. As
// QuadtreeMesher does for its budget, it counts triangles as a function of the limit (find_limit), here over the
// critical values of bisection_criterion.cpp.
#include "visuals/terrain/bisection_selection.h"

#include "visuals/terrain/fan_triangles.h"
#include "visuals/terrain/frustum.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

namespace octant::visuals::terrain {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float min_limit = 1e-30F; ///< Below every critical value but the root's.
/// The error that is tried first when there is no last frame.
constexpr double first_look_px = 4.0;

} // namespace

double margin_share(const ErrorTarget& target) {
    const bool has_budget = target.max_triangles < unlimited_triangles;
    const double share = target.error_px / full_margin_px * std::max(target.error_px / near_margin_px, 1.0);
    return has_budget ? 1.0 : std::min(share, 1.0);
}

float BisectionSelection::limit_for(const ErrorTarget& target) {
    assert(target.error_px >= 0.0 && target.max_triangles >= 1);
    nodes_tested_ = 0;
    geomorphs_ = target.geomorphs;
    const float max_limit = std::max(criterion_->limit_of(target.error_px), min_limit);
    if (target.max_triangles >= unlimited_triangles) {
        start(max_limit);
        visit<false>(root_visit());
        return max_limit;
    }
    const CountSearch search{target.max_triangles, min_limit, max_limit,
        last_error_px_ > 0.0 ? criterion_->limit_of(last_error_px_) : 0.0F, criterion_->limit_of(first_look_px)};
    const float found = find_limit(search, steps_, [&](float low, float high, int max_triangles) {
        start(high);
        steps_.start(low, high);
        max_triangles_ = max_triangles;
        visit<true>(root_visit());
        return has_steps_above_;
    });
    last_error_px_ = criterion_->error_px_of(found);
    return found;
}

void BisectionSelection::start(float high) {
    count_ = 0;
    next_node();
    nodes_.front() = BisectionNode();
    high_ = high;
    has_steps_above_ = false;
    distances_[0][0] = criterion_->vertical_distances_of(0, 0, 0);
}

BisectionSelection::PendingNode BisectionSelection::root_visit() const {
    PendingNode root;
    root.place.distances = distances_[0].data();
    root.planes = active_planes(criterion_->view().frustum_normals);
    root.error_m = criterion_->root_error_m();
    return root;
}

/// The index of a new node.
inline std::size_t BisectionSelection::next_node() {
    if (count_ == nodes_.size()) { nodes_.resize(2 * count_ + 1024); }
    return count_++;
}

/// Collects a node and all nodes below it that may be in the mesh, and returns its index. Counts triangles only if
/// there is a budget.
template <bool counting>
std::uint32_t BisectionSelection::visit(const PendingNode& from) {
    const std::size_t own = next_node();
    if (counting && steps_.at_high() > max_triangles_) { return static_cast<std::uint32_t>(own); }
    const FanCriticalValues criticals = criterion_->criticals_of(from.place);
    Children children;
    if (from.place.level + 1 < criterion_->ground().levels()) { test_children(from, children); }
    BisectionNode* node = &nodes_[own];
    node->middle = criticals.middle;
    node->quadrant = criticals.quadrant;
    node->child = {};
    node->node_limit = from.node_limit;
    node->column = static_cast<std::uint16_t>(from.place.column);
    node->row = static_cast<std::uint16_t>(from.place.row);
    node->level = static_cast<std::uint8_t>(from.place.level);
    node->hidden = static_cast<std::uint8_t>(children.hidden);
    std::array<int, 4> replaced = uncut_fan_triangles.of_quadrant;
    if (counting) { count(from, *node, replaced); }
    unsigned looked_at = 0;
    for (unsigned q = 0; q < 4; ++q) { looked_at |= (criticals.quadrant[q] < high_ ? 1U : 0U) << q; }
    for (unsigned left = looked_at & ~children.hidden; left != 0; left &= left - 1) {
        const auto q = static_cast<unsigned>(std::countr_zero(left));
        PendingNode next;
        next.place = child_place(from.place, q);
        if (next.place.level <= criterion_->ground().layout().range_level()) {
            VerticalDistances& distances = distances_[static_cast<std::size_t>(next.place.level)][q];
            distances = criterion_->vertical_distances_of(next.place.level, next.place.column, next.place.row);
            next.place.distances = &distances;
        }
        next.planes = children.planes[q];
        next.node_limit = criticals.quadrant[q];
        next.error_m = criticals.quadrant_error_m[q];
        next.replaced = replaced[q];
        const std::uint32_t child = visit<counting>(next);
        nodes_[own].child[q] = child;
    }
    return static_cast<std::uint32_t>(own);
}

/// A child's place, with the vertical distances of its parent.
inline NodeContext BisectionSelection::child_place(const NodeContext& place, unsigned quadrant) {
    return {place.level + 1, 2 * place.column + static_cast<int>(quadrant & 1U),
        2 * place.row + static_cast<int>(quadrant >> 1U), place.distances};
}

/// Whether the field's border cuts a node.
inline bool BisectionSelection::is_cut(const GroundLayout::Level& at, const NodeContext& place) const {
    const GroundTiles& ground = criterion_->ground();
    return (place.column + 1) * at.edge >= ground.columns() || (place.row + 1) * at.edge >= ground.rows();
}

/// Finds out which children are hidden, and what they need from their parent.
inline void BisectionSelection::test_children(const PendingNode& from, Children& children) {
    const GroundLayout& layout = criterion_->ground().layout();
    const GroundLayout::Level& at = layout.level(from.place.level + 1);
    const bool has_own_distances = from.place.level < layout.range_level();
    for (unsigned q = 0; q < 4; ++q) {
        const NodeContext place = child_place(from.place, q);
        if (place.column >= at.columns || place.row >= at.rows) {
            children.hidden |= 1U << q;
            continue;
        }
        ++nodes_tested_;
        if (from.planes != 0) {
            const GroundTiles& ground = criterion_->ground();
            const float lowest_m = has_own_distances ? ground.lowest_m(place.level, place.column, place.row)
                                                     : from.place.distances->lowest_m;
            const float highest_m = has_own_distances ? ground.highest_m(place.level, place.column, place.row)
                                                      : from.place.distances->highest_m;
            // Where the border cuts a node, points on it are between samples of the padded square.
            const bool moves = geomorphs_ || is_cut(at, place);
            const float margin_m = moves ? from.error_m : 0.0F;
            children.planes[q] = criterion_->crossed_planes_of_node(place, lowest_m, highest_m, margin_m, from.planes);
            children.hidden |= children.planes[q] == outside_frustum ? 1U << q : 0U;
        }
    }
}

/// Adds the steps of a node's fan to the count. `replaced` is set to the triangles of its quadrants where the field's
/// end cuts it.
inline void BisectionSelection::count(
    const PendingNode& from, const BisectionNode& node, std::array<int, 4>& replaced) {
    for (unsigned k = 0; k < 4 && !has_steps_above_; ++k) {
        has_steps_above_ =
            (node.middle[k] >= high_ && node.middle[k] < infinite) ||
            (node.quadrant[k] >= high_ && node.quadrant[k] < infinite && (unsigned{node.hidden} >> k & 1U) == 0);
    }
    const GroundTiles& ground = criterion_->ground();
    const FanSamples samples(ground, ground.layout().level(node.level).edge, node.column, node.row);
    const std::array<float, 4> middle = {node.middle[0], node.middle[1], node.middle[2], node.middle[3]};
    const FanLimits limits{node.node_limit, middle, node.hidden, from.replaced};
    if (samples.is_cut()) {
        const FanTriangles triangles = triangles_within_border(samples);
        replaced = triangles.of_quadrant;
        count_fan(limits, triangles, high_, steps_);
    } else if (node.hidden != 0) {
        count_fan(limits, uncut_fan_triangles, high_, steps_);
    } else {
        steps_.add(node.node_limit, 4 - from.replaced);
        for (unsigned k = 0; k < 4; ++k) {
            if (node.middle[k] < high_) { steps_.add(node.middle[k], 1); }
        }
    }
}

} // namespace octant::visuals::terrain
