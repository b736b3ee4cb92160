// Triangle fans of a restricted quadtree: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method
// that Minimize Flickering Effect", equations (1) and (3) and steps 3 and 4 of section 2; fans
// after S. Roettger, W. Heidrich, P. Slusallek, H.-P. Seidel, "Real-Time Generation of Continuous
// Levels of Detail for Height Fields".
//
// Step 3 walks down the tree from the root and collects the nodes that are split (visit, add); step
// 4 emits a full or partial fan for each of them (mesher_triangles.cpp). A fan leaves out the
// mid-points of edges beyond which the neighbour is coarser, so that there are no cracks.
//
// Deviations:
// - Triangles come in painting order (paint_order.cpp). The paper draws with a depth buffer.
// - An edge keeps its mid-point where this node has a child beside it; otherwise where the node
//   beyond the edge is in the mesh, or would be but for the frustum; and always at the field's
//   border.
// - Those of equation (3) are stated in split_rule.cpp.
#include "visuals/terrain/quadtree_mesher.h"

#include "visuals/terrain/frustum.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace octant::visuals::terrain {

QuadtreeMesher::QuadtreeMesher(const Quadtree& tree, std::span<const std::uint32_t> colours)
    : tree_(&tree)
    , rule_(tree)
    , survey_(tree)
    , in_mesh_(tree.nodes().size(), 0) {
    set_colours(colours);
    assert(tree.levels() <= 16);
}

void QuadtreeMesher::set_colours(std::span<const std::uint32_t> colours) {
    assert(
        colours.size() == static_cast<std::size_t>(tree_->field().columns()) *
                              static_cast<std::size_t>(tree_->field().rows()));
    colours_ = colours;
}

GroundMesh QuadtreeMesher::mesh(const MeshView& view, const QuadtreeDetail& detail) {
    collect(view, detail);
    return counted_mesh();
}

GroundMesh
QuadtreeMesher::mesh_within(const MeshView& view, const QuadtreeDetail& detail, const TriangleBudget& budget) {
    collect_within(view, detail, budget);
    return counted_mesh();
}

CountedMesh QuadtreeMesher::count(const MeshView& view, const QuadtreeDetail& detail) {
    collect(view, detail);
    return count_fans();
}

CountedMesh
QuadtreeMesher::count_within(const MeshView& view, const QuadtreeDetail& detail, const TriangleBudget& budget) {
    collect_within(view, detail, budget);
    return count_fans();
}

/// Fills fans_ with the nodes of the mesh at a given C.
void QuadtreeMesher::collect(const MeshView& view, const QuadtreeDetail& detail) {
    rule_.set_view(view, detail);
    limit_ = rule_.limit_squared(detail.resolution);
    resolution_ = std::max(detail.resolution, tree_->options().min_resolution);
    start(view);
    visit({}, active_planes(view.frustum_normals));
    for (std::size_t k = 0; k < fans_.size(); ++k) {
        fan_records_[k].middles = static_cast<std::uint8_t>(midpoints_of(fans_[k]));
    }
    for (const GroundFan& fan : fans_) {
        in_mesh_[fan.node] = 0;
    }
}

/// Fills fans_ with the nodes of the mesh at the largest C that the budget allows.
void QuadtreeMesher::collect_within(
    const MeshView& view, const QuadtreeDetail& detail, const TriangleBudget& budget) {
    rule_.set_view(view, detail);
    limit_ = survey_.limit_for(rule_, budget);
    resolution_ = rule_.resolution_of(limit_);
    start(view);
    counters_.nodes_visited = survey_.nodes_tested();
    for (const SelectedNode& node : survey_.nodes()) {
        if (node.node_limit >= limit_) {
            continue;
        }
        GroundFan fan = node.fan;
        unsigned middles = 0;
        for (unsigned k = 0; k < 4; ++k) {
            fan.split |= static_cast<std::uint8_t>(node.split[k] < limit_ ? 1U << k : 0U);
            middles |= node.middle[k] < limit_ ? 1U << k : 0U;
        }
        add(fan, middles);
    }
}

/// Prepares for a new mesh.
void QuadtreeMesher::start(const MeshView& view) {
    fans_.clear();
    fan_records_.clear();
    counters_ = {};
    is_collected_ = true;
    orders_ = painting_orders(view.order).data();
    eye_ = glm::dvec2(-rule_.west_m(), -rule_.south_m()) / tree_->field().spacing_m();
}

/// Adds a node that is in the mesh to fans_, after its parent. Returns its index.
std::size_t QuadtreeMesher::add(const GroundFan& fan, unsigned middles) {
    const std::size_t own = fans_.size();
    last_fan_of_level_[fan.level] = static_cast<std::uint32_t>(own);
    if (fan.level > 0) {
        const unsigned quadrant = (fan.column & 1U) | (fan.row & 1U) << 1U;
        fan_records_[last_fan_of_level_[fan.level - 1U]].child[quadrant] = last_fan_of_level_[fan.level];
    }
    fans_.push_back(fan);
    fan_records_.emplace_back().middles = static_cast<std::uint8_t>(middles);
    return own;
}

GroundMesh QuadtreeMesher::counted_mesh() {
    assert(is_collected_);
    is_collected_ = false;
    reserve();
    emit(0, nullptr, 0);
    counters_.triangles = static_cast<int>(index_count_ / 3);
    return {
        std::span(vertices_).first(vertex_count_),
        std::span(indices_).first(index_count_),
        counters_,
        resolution_,
        0.0,
        {}};
}

/// Whether a node is in the unculled mesh: it and all of its ancestors are switched on.
bool QuadtreeMesher::is_split(int level, int column, int row) const {
    for (; level > 0; --level) {
        if (!is_split_by_distance(level, column, row)) {
            return false;
        }
        column /= 2;
        row /= 2;
    }
    return true;
}

/// Adds a node and all nodes that are split below it to fans_. `planes` are the frustum planes that
/// the node's box may reach beyond.
void QuadtreeMesher::visit(GroundFan fan, unsigned planes) {
    fan.crosses_frustum = planes != 0;
    in_mesh_[fan.node] = 1;
    const std::size_t own = add(fan, 0);
    const int below = fan.level + 1;
    if (below == tree_->levels()) {
        return;
    }
    const QuadtreeCriterion::Level& next = rule_.level(below);
    std::array<GroundFan, 4> children;
    std::array<unsigned, 4> child_planes{};
    for (unsigned q = 0; q < 4; ++q) {
        const int column = 2 * fan.column + static_cast<int>(q & 1U);
        const int row = 2 * fan.row + static_cast<int>(q >> 1U);
        const auto quadrant = static_cast<std::uint8_t>(1U << q);
        if (column >= next.columns || row >= next.rows) {
            fan.hidden |= quadrant;
            continue;
        }
        GroundFan& child = children[q];
        child.node = rule_.node_at(below, column, row);
        child.column = static_cast<std::uint16_t>(column);
        child.row = static_cast<std::uint16_t>(row);
        child.level = static_cast<std::uint8_t>(below);
        ++counters_.nodes_visited;
        child_planes[q] = planes == 0 ? 0 : rule_.crossed_planes_of_node(child, planes);
        if (child_planes[q] == outside_frustum) {
            fan.hidden |= quadrant;
        }
        if (is_split_by_distance(below, column, row)) {
            fan.split |= quadrant;
        }
    }
    fans_[own] = fan;
    const unsigned drawn = fan.split & ~static_cast<unsigned>(fan.hidden);
    for (unsigned q = 0; q < 4; ++q) {
        if ((drawn >> q & 1U) != 0) {
            visit(children[q], child_planes[q]);
        }
    }
}

/// Whether the node beyond an edge is in the mesh, or the field ends there.
bool QuadtreeMesher::has_neighbour(const GroundFan& fan, int east, int north) const {
    const QuadtreeCriterion::Level& at = rule_.level(fan.level);
    const int column = fan.column + east;
    const int row = fan.row + north;
    if (column < 0 || row < 0 || column >= at.columns || row >= at.rows) {
        return true;
    }
    const std::ptrdiff_t step = east + static_cast<std::ptrdiff_t>(north) * at.columns;
    if (in_mesh_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(fan.node) + step)] != 0) {
        return true;
    }
    return fan.crosses_frustum && is_split(fan.level, column, row);
}

/// The set of edges that have a mid-point, as bits by fan_edges.
unsigned QuadtreeMesher::midpoints_of(const GroundFan& fan) const {
    unsigned middles = 0;
    for (unsigned k = 0; k < 4; ++k) {
        const FanEdge& edge = fan_edges[k];
        if ((fan.split & (1U << edge.quadrant_a | 1U << edge.quadrant_b)) != 0 ||
            has_neighbour(fan, edge.beyond_east, edge.beyond_north)) {
            middles |= 1U << k;
        }
    }
    return middles;
}

} // namespace octant::visuals::terrain
