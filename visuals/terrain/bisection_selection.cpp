// The smallest screen-space error that keeps a budget of triangles, exactly and in the same frame. It has no source. As
// QuadtreeMesher does for its budget, it counts triangles as a function of the limit (find_limit), here over the
// critical values of bisection_criterion.cpp.
#include "visuals/terrain/bisection_selection.h"

#include "visuals/terrain/fan_triangles.h"
#include "visuals/terrain/frustum.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace octant::visuals::terrain {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float min_limit = 1e-30F; ///< Below every critical value but the root's.
/// The error that is tried first when there is no last frame.
constexpr double first_look_px = 4.0;
/// The error that is tried first, over that of a last view that has nothing in common with this one.
constexpr double other_view_look = 1.5;

/// The child of a node in a quadrant.
NodeContext child_place(const NodeContext& place, unsigned quadrant) {
    return {place.level + 1, 2 * place.column + static_cast<int>(quadrant & 1U),
        2 * place.row + static_cast<int>(quadrant >> 1U), place.distances};
}

NodeContext place_of(const BisectionNode& node) { return {node.level, node.column, node.row, nullptr}; }

} // namespace

double margin_share(const ErrorTarget& target) {
    const bool has_budget = target.max_triangles < unlimited_triangles;
    const double share = target.error_px / full_margin_px * std::max(target.error_px / near_margin_px, 1.0);
    return has_budget ? 1.0 : std::min(share, 1.0);
}

float BisectionSelection::limit_for(const ErrorTarget& target) {
    assert(target.error_px >= 0.0 && target.max_triangles >= 1);
    geomorphs_ = target.geomorphs;
    start();
    const float max_limit = std::max(criterion_->limit_of(target.error_px), min_limit);
    if (target.max_triangles >= unlimited_triangles) {
        walk<false>(max_limit, 0);
        return max_limit;
    }
    const bool is_other = std::exchange(is_other_view_, false) && last_error_px_ > 0.0;
    const CountSearch search{target.max_triangles, min_limit, max_limit,
        last_error_px_ > 0.0 && !is_other ? criterion_->limit_of(last_error_px_) : 0.0F,
        criterion_->limit_of(is_other ? other_view_look * last_error_px_ : first_look_px)};
    const float found = find_limit(search, steps_, [&](float low, float high, int max_triangles) {
        steps_.start(low, high);
        return walk<true>(high, max_triangles);
    });
    last_error_px_ = criterion_->error_px_of(found);
    return found;
}

/// Forgets all nodes and collects the root.
void BisectionSelection::start() {
    nodes_tested_ = 0;
    distances_.clear();
    if (nodes_.empty()) {
        nodes_.resize(1024);
        states_.resize(nodes_.size());
    }
    count_ = 1;
    NewNode root;
    root.planes = active_planes(criterion_->view().frustum_normals);
    root.error_m = criterion_->root_error_m();
    collect(root);
}

/// Adds a node without children, and returns its index.
std::uint32_t BisectionSelection::collect(const NewNode& made) {
    if (count_ == nodes_.size()) {
        nodes_.resize(2 * count_);
        states_.resize(nodes_.size());
    }
    const auto own = static_cast<std::uint32_t>(count_++);
    NodeContext place = made.place;
    std::size_t distances = made.distances;
    if (place.level <= criterion_->ground().layout().range_level()) {
        distances = distances_.size();
        distances_.push_back(criterion_->vertical_distances_of(place.level, place.column, place.row));
    }
    place.distances = &distances_[distances];
    const FanCriticalValues criticals = criterion_->criticals_of(place);
    NodeState& state = states_[own];
    state = {criticals.quadrant_error_m, {}, {2, 2, 2, 2}, static_cast<std::uint32_t>(distances),
        static_cast<std::uint8_t>(made.replaced), is_cut(criterion_->ground().layout().level(place.level), place)};
    BisectionNode& node = nodes_[own];
    node.middle = criticals.middle;
    node.quadrant = criticals.quadrant;
    node.child = {};
    node.node_limit = made.node_limit;
    node.column = static_cast<std::uint16_t>(place.column);
    node.row = static_cast<std::uint16_t>(place.row);
    node.level = static_cast<std::uint8_t>(place.level);
    const bool is_finest = place.level + 1 == criterion_->ground().levels();
    node.hidden = static_cast<std::uint8_t>(is_finest ? 0U : test_children(made, *place.distances, state));
    return own;
}

/// Collects all nodes whose critical values are below a limit, and counts their triangles in steps_ if there is a
/// budget. Nodes from earlier walks of the view stay. Ends early once there are more than `max_triangles`. Returns
/// whether something visible appears only above the limit.
template <bool counting>
bool BisectionSelection::walk(float high, int max_triangles) {
    bool has_steps_above = false;
    for (std::uint32_t own = 1; own < count_; ++own) {
        if (counting && steps_.at_high() > max_triangles) { break; }
        if (nodes_[own].node_limit >= high) { continue; } // from a walk that went further
        if (counting) { has_steps_above = count(own, high) || has_steps_above; }
        for (unsigned q = 0; q < 4; ++q) {
            const BisectionNode& node = nodes_[own];
            if (node.quadrant[q] < high && node.child[q] == 0 && (unsigned{node.hidden} >> q & 1U) == 0) {
                collect_child(own, q);
            }
        }
    }
    return has_steps_above;
}

void BisectionSelection::collect_child(std::uint32_t parent, unsigned quadrant) {
    const BisectionNode& node = nodes_[parent];
    const NodeState& state = states_[parent];
    const std::uint32_t child = collect({child_place(place_of(node), quadrant), state.distances, state.planes[quadrant],
        node.quadrant[quadrant], state.quadrant_error_m[quadrant], state.of_quadrant[quadrant]});
    nodes_[parent].child[quadrant] = child;
}

/// Whether the field's border cuts a node.
inline bool BisectionSelection::is_cut(const GroundLayout::Level& at, const NodeContext& place) const {
    const GroundTiles& ground = criterion_->ground();
    return (place.column + 1) * at.edge >= ground.columns() || (place.row + 1) * at.edge >= ground.rows();
}

/// Returns which children are hidden, and fills in what they need from their parent.
inline unsigned BisectionSelection::test_children(
    const NewNode& made, const VerticalDistances& distances, NodeState& state) {
    const GroundTiles& ground = criterion_->ground();
    const GroundLayout& layout = ground.layout();
    const GroundLayout::Level& at = layout.level(made.place.level + 1);
    const bool has_own_distances = made.place.level < layout.range_level();
    unsigned hidden = 0;
    for (unsigned q = 0; q < 4; ++q) {
        const NodeContext place = child_place(made.place, q);
        if (place.column >= at.columns || place.row >= at.rows) {
            hidden |= 1U << q;
            continue;
        }
        ++nodes_tested_;
        if (made.planes != 0) {
            const float lowest_m =
                has_own_distances ? ground.lowest_m(place.level, place.column, place.row) : distances.lowest_m;
            const float highest_m =
                has_own_distances ? ground.highest_m(place.level, place.column, place.row) : distances.highest_m;
            // Where the border cuts a node, points on it are between samples of the padded square.
            const bool moves = geomorphs_ || is_cut(at, place);
            const float margin_m = moves ? made.error_m : 0.0F;
            const unsigned planes =
                criterion_->crossed_planes_of_node(place, lowest_m, highest_m, margin_m, made.planes);
            state.planes[q] = static_cast<std::uint8_t>(planes);
            hidden |= planes == outside_frustum ? 1U << q : 0U;
        }
    }
    return hidden;
}

/// Adds the steps of a node's fan below a limit to the count. Returns whether there are steps above.
inline bool BisectionSelection::count(std::uint32_t own, float high) {
    const BisectionNode& node = nodes_[own];
    NodeState& state = states_[own];
    bool has_steps_above = false;
    for (unsigned k = 0; k < 4; ++k) {
        has_steps_above =
            has_steps_above || (node.middle[k] >= high && node.middle[k] < infinite) ||
            (node.quadrant[k] >= high && node.quadrant[k] < infinite && (unsigned{node.hidden} >> k & 1U) == 0);
    }
    const std::array<float, 4> middle = {node.middle[0], node.middle[1], node.middle[2], node.middle[3]};
    const FanLimits limits{node.node_limit, middle, node.hidden, state.replaced};
    if (state.is_cut) {
        const GroundTiles& ground = criterion_->ground();
        const FanTriangles triangles =
            triangles_within_border(FanSamples(ground, ground.layout().level(node.level).edge, node.column, node.row));
        std::ranges::copy(triangles.of_quadrant, state.of_quadrant.begin());
        count_fan(limits, triangles, high, steps_);
    } else if (node.hidden != 0) {
        count_fan(limits, uncut_fan_triangles, high, steps_);
    } else {
        steps_.add(node.node_limit, 4 - state.replaced);
        for (unsigned k = 0; k < 4; ++k) {
            if (node.middle[k] < high) { steps_.add(node.middle[k], 1); }
        }
    }
    return has_steps_above;
}

} // namespace octant::visuals::terrain
