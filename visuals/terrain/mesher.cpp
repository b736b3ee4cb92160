// Triangle fans of a restricted quadtree.
//
// Source: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that Minimize Flickering Effect",
// equations (1) and (3) and steps 3 and 4 of section 2; fans after S. Roettger, W. Heidrich, P.
// Slusallek, H.-P. Seidel, "Real-Time Generation of Continuous Levels of Detail for Height Fields".
// Deviations:
// - An edge keeps its mid-point where this node has a child beside it; else where the node beyond
//   the edge is in the mesh or would be but for the frustum; and always at the field's border.
// - See split_rule.cpp for those of equation (3).
#include "visuals/terrain/mesher.h"

#include "visuals/terrain/frustum.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace octant::visuals::terrain {

Mesher::Mesher(const Quadtree& tree, std::span<const std::uint32_t> colours)
    : tree_(&tree)
    , colours_(colours)
    , rule_(tree)
    , survey_(tree)
    , in_mesh_(tree.nodes().size(), 0)
    , vertex_of_sample_(colours.size(), 0) {
    [[maybe_unused]] const models::HeightField& field = tree.field();
    assert(
        colours.size() ==
        static_cast<std::size_t>(field.columns()) * static_cast<std::size_t>(field.rows()));
    assert(tree.levels() <= 16);
}

GroundMesh Mesher::mesh(const MeshView& view, const Detail& detail) {
    rule_.look_from(view, detail);
    limit_ = rule_.limit_squared(detail.resolution);
    fans_.clear();
    counters_ = {};
    visit({}, planes_of(view.frustum_normals));
    make_room(fans_.size());
    for (const GroundFan& fan : fans_) {
        emit(fan, middles_of(fan));
    }
    for (const GroundFan& fan : fans_) {
        in_mesh_[fan.node] = 0;
    }
    return finished(std::max(detail.resolution, tree_->options().min_resolution));
}

GroundMesh
Mesher::mesh_within(const MeshView& view, const Detail& detail, const TriangleBudget& budget) {
    rule_.look_from(view, detail);
    limit_ = survey_.limit_for(rule_, budget);
    fans_.clear();
    counters_ = {};
    counters_.nodes_visited = survey_.nodes_tested();
    make_room(survey_.nodes().size());
    for (const SurveyedNode& node : survey_.nodes()) {
        if (node.on >= limit_) {
            continue;
        }
        GroundFan fan = node.fan;
        unsigned middles = 0;
        for (unsigned k = 0; k < 4; ++k) {
            fan.split |= static_cast<std::uint8_t>(node.split[k] < limit_ ? 1U << k : 0U);
            middles |= node.middle[k] < limit_ ? 1U << k : 0U;
        }
        fans_.push_back(fan);
        emit(fan, middles);
    }
    return finished(rule_.resolution_of(limit_));
}

GroundMesh Mesher::finished(double resolution) {
    first_stamp_ += vertex_count_;
    counters_.triangles = static_cast<int>(index_count_ / 3);
    return {
        std::span(vertices_).first(vertex_count_),
        std::span(indices_).first(index_count_),
        counters_,
        resolution};
}

/// Whether a node is in the unculled mesh.
bool Mesher::is_split(int level, int column, int row) const {
    for (; level > 0; --level) {
        if (!wants_split(level, column, row)) {
            return false;
        }
        column /= 2;
        row /= 2;
    }
    return true;
}

/// Puts a node and all that is split below it into fans_. `planes`: those that the node's box may
/// reach beyond.
void Mesher::visit(GroundFan fan, unsigned planes) {
    fan.at_frustum = planes != 0;
    in_mesh_[fan.node] = 1;
    const std::size_t own = fans_.size();
    fans_.push_back(fan);
    const int below = fan.level + 1;
    if (below == tree_->levels()) {
        return;
    }
    const SplitRule::Level& next = rule_.level(below);
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
        child_planes[q] = planes == 0 ? 0 : rule_.planes_cutting_node(child, planes);
        if (child_planes[q] == outside_frustum) {
            fan.hidden |= quadrant;
        }
        if (wants_split(below, column, row)) {
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

/// Room for nine vertices and eight triangles a fan, and stamps for all of them.
void Mesher::make_room(std::size_t fans) {
    const std::size_t most_vertices = std::min(9 * fans, vertex_of_sample_.size());
    if (vertices_.size() < most_vertices) {
        vertices_.resize(most_vertices + most_vertices / 4);
    }
    if (indices_.size() < 24 * fans) {
        indices_.resize(30 * fans);
    }
    vertex_count_ = 0;
    index_count_ = 0;
    if (std::numeric_limits<std::uint32_t>::max() - first_stamp_ < most_vertices) {
        std::fill(vertex_of_sample_.begin(), vertex_of_sample_.end(), 0U);
        first_stamp_ = 1;
    }
}

/// Whether the node beyond one edge is in the mesh, or the field ends there.
bool Mesher::has_neighbour(const GroundFan& fan, int east, int north) const {
    const SplitRule::Level& at = rule_.level(fan.level);
    const int column = fan.column + east;
    const int row = fan.row + north;
    if (column < 0 || row < 0 || column >= at.columns || row >= at.rows) {
        return true;
    }
    const std::ptrdiff_t step = east + static_cast<std::ptrdiff_t>(north) * at.columns;
    if (in_mesh_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(fan.node) + step)] != 0) {
        return true;
    }
    return fan.at_frustum && is_split(fan.level, column, row);
}

/// Bit k: edge k of fan_edges has a mid-point.
unsigned Mesher::middles_of(const GroundFan& fan) const {
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

void Mesher::emit(const GroundFan& fan, unsigned middles) {
    if (fan.split == all_quadrants) {
        return;
    }
    const FanSamples samples(tree_->field(), rule_.level(fan.level).edge, fan.column, fan.row);
    const bool cut = samples.is_cut();
    const Sample centre = samples.at(1, 1);
    const std::size_t first_index = index_count_;
    const auto triangle = [&](Sample a, Sample b) {
        if (cut && !has_area(centre, a, b)) {
            return;
        }
        indices_[index_count_] = vertex_at(centre);
        indices_[index_count_ + 1] = vertex_at(a);
        indices_[index_count_ + 2] = vertex_at(b);
        index_count_ += 3;
    };
    const unsigned covered = fan.split | fan.hidden;
    for (unsigned k = 0; k < 4; ++k) {
        const FanEdge& edge = fan_edges[k];
        const Sample a = samples.corner_a(edge);
        const Sample b = samples.corner_b(edge);
        if ((middles >> k & 1U) == 0) {
            triangle(a, b);
            continue;
        }
        const Sample middle = samples.middle(edge);
        if ((covered >> edge.quadrant_a & 1U) == 0) {
            triangle(a, middle);
        }
        if ((covered >> edge.quadrant_b & 1U) == 0) {
            triangle(middle, b);
        }
    }
    counters_.fans += index_count_ > first_index ? 1 : 0;
}

std::uint32_t Mesher::vertex_at(Sample at) {
    const models::HeightField& field = tree_->field();
    const std::size_t sample =
        static_cast<std::size_t>(at.row) * static_cast<std::size_t>(field.columns()) +
        static_cast<std::size_t>(at.column);
    std::uint32_t& stamp = vertex_of_sample_[sample];
    if (stamp >= first_stamp_) {
        return stamp - first_stamp_;
    }
    stamp = first_stamp_ + vertex_count_;
    const double height_m = static_cast<double>(field.height_m(at.column, at.row));
    vertices_[vertex_count_] = {
        glm::vec3(
            static_cast<float>(rule_.west_m() + at.column * field.spacing_m()),
            static_cast<float>(rule_.south_m() + at.row * field.spacing_m()),
            static_cast<float>(height_m - rule_.view().eye_m.z)),
        colours_[sample]};
    return vertex_count_++;
}

} // namespace octant::visuals::terrain
