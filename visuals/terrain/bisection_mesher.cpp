// Triangle fans of a longest-edge bisection with geomorphs. Which samples are in the mesh is decided by
// bisection_criterion.cpp (P. Lindstrom, V. Pascucci, 2002).
//
// A bisected field is a quadtree of fans around the centres of nodes: a fan's quadrant is left to the child if the
// child's centre is in the mesh, and an edge has a mid-point if that sample is in the mesh. So no neighbour needs to be
// asked, unlike in Roettger's restricted quadtree (quadtree_mesher.cpp). The order of drawing is that of
// paint_order.cpp.
//
// Geomorphs: a vertex is drawn between its sample and the middle of its two ends. The ends are an edge's corners or,
// for a child's centre, the parent's centre and the parent's corner; they are always an edge of the mesh without the
// vertex. The weight of the sample is
//   w = (1 - 1 / f) / (1 - r),
// at most 1, where f >= 1 is the vertex's error on the screen over the one wanted, and r is the largest error of the
// samples that need it over its own, at least 1 / morph_ratio. So those samples, which appear at r f > 1 at the
// earliest, find the vertex at rest, and of all vertices that shape a place only the last one moves. The ground there
// is the mean of two meshes, without the vertex (errors up to f) and with it (up to r f), and its error is at most (1 -
// w) f + w r f, which is never more than 1: geomorphs keep the bound. Where the eye comes nearer by a small share of
// its distance, a vertex that lies d target errors from the middle of its ends moves by d / (1 - r) times that share at
// most, and the errors of bisection_tile_builder.cpp keep d / (1 - r) small.
//
// Deviations from Lindstrom and Pascucci:
// - Where the field's end cuts a node, the mesh is that of the padded square (bisection_tiles.h), and
//   its triangles are cut off at the border (fan_triangles.cpp).
// - Corners and centre of the root are always in the mesh, at their samples.
#include "visuals/terrain/bisection_mesher.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace octant::visuals::terrain {

namespace {

/// The index in fan_ring of a quadrant's corner.
constexpr std::array<std::uint8_t, 4> ring_of_quadrant = {0, 2, 6, 4};

/// For each set of hidden quadrants the edges that border on a visible quadrant.
constexpr std::array<std::uint8_t, 16> edges_of_visible = [] {
    std::array<std::uint8_t, 16> edges{};
    for (unsigned hidden = 0; hidden < 16; ++hidden) {
        for (unsigned k = 0; k < 4; ++k) {
            const unsigned adjacent = 1U << fan_edges[k].quadrant_a | 1U << fan_edges[k].quadrant_b;
            edges[hidden] |= static_cast<std::uint8_t>((adjacent & ~hidden) != 0 ? 1U << k : 0U);
        }
    }
    return edges;
}();

} // namespace

BisectionMesher::BisectionMesher(const GroundTiles& ground)
    : ground_(&ground), criterion_(ground), selection_(criterion_), horizon_(ground),
      border_vertices_(static_cast<std::size_t>(ground.rows()) + static_cast<std::size_t>(ground.columns())) {}

GroundMesh BisectionMesher::mesh(const MeshView& view, const ErrorTarget& target) {
    if (has_mesh_ && view == view_ && target == target_) { return mesh_; }
    has_mesh_ = false;
    view_ = view;
    target_ = target;
    criterion_.set_view(view, margin_share(target));
    limit_ = selection_.limit_for(horizon_.raise_to_horizon_error(view, target));
    nodes_ = selection_.nodes();
    morph_limit_ = target.geomorphs ? limit_ : std::numeric_limits<float>::infinity();
    height_base_m_ = ground_->shape().height_base_m - view.eye_m.z;
    orders_ = painting_orders(view.order).data();
    eye_ = glm::dvec2(-criterion_.west_m(), -criterion_.south_m()) / ground_->spacing_m();
    counters_ = {};
    counters_.nodes_visited = selection_.nodes_tested();
    std::swap(vertices_, last_vertices_);
    std::swap(indices_, last_indices_);
    reserve();
    EmittedFan root = root_fan();
    emit(root);
    counters_.triangles = static_cast<int>(index_count_ / 3);
    mesh_ = {std::span(vertices_).first(vertex_count_), std::span(indices_).first(index_count_), counters_, 0.0,
        criterion_.error_px_of(limit_), std::span(morphs_).first(vertex_count_)};
    has_mesh_ = true;
    return mesh_;
}

void BisectionMesher::expect_other_view() {
    selection_.expect_other_view();
    horizon_.expect_other_view();
}

/// Reserves memory for five vertices and eight triangles for each node, and for the root's corners.
void BisectionMesher::reserve() {
    const std::size_t count = nodes_.size();
    if (vertices_.size() < 5 * count + 4) { vertices_.resize(6 * count + 4); }
    if (morphs_.size() < vertices_.size()) { morphs_.resize(vertices_.size()); }
    if (indices_.size() < 24 * count) { indices_.resize(30 * count); }
    if (triangle_ranges_.size() < count) {
        triangle_ranges_.resize(count + count / 4);
        middle_vertex_.resize(triangle_ranges_.size());
        drawn_heights_.resize(triangle_ranges_.size());
    }
    std::fill_n(middle_vertex_.begin(), count, Four{});
    vertex_count_ = 0;
    index_count_ = 0;
    cut_nodes_ = 0;
    ++mesh_number_;
}

/// The root's fan with its corners and centre.
BisectionMesher::EmittedFan BisectionMesher::root_fan() {
    const LevelReader& memory = criterion_.memory(0);
    const FanSamples samples(*ground_, memory.edge(), 0, 0);
    EmittedFan root;
    root.node = root_node;
    root.beyond = {};
    for (std::size_t q = 0; q < 4; ++q) {
        const std::size_t place = ring_of_quadrant[q];
        root.ring[place] = fixed_vertex(samples.padded_ring(place), memory.corner_height(q));
    }
    root.ring[centre_of_ring] = fixed_vertex(samples.padded(1, 1), memory.centre_height(memory.slot(0, 0)));
    return root;
}

/// A vertex that is always there.
std::uint32_t BisectionMesher::fixed_vertex(GridSample at, std::int16_t height) {
    return add_vertex({at, vertex_count_, vertex_count_, height, 1.0F});
}

/// The weight w of a vertex with a critical value (the head of this file). `share_below` tells r where it is needed.
template <typename ShareBelow>
inline float BisectionMesher::weight_of(float critical, const ShareBelow& share_below) const {
    // f^2 of the head: a limit falls with the square of the error in pixels (BisectionCriterion::limit_of), as a
    // critical value does.
    const float over = morph_limit_ / critical;
    if (over >= morph_ratio * morph_ratio) { return 1.0F; }
    const float below = std::max(share_below(), 1.0F / morph_ratio);
    const float min_weight = 1.0F - 1.0F / std::sqrt(over);
    return min_weight >= 1.0F - below ? 1.0F : std::max(min_weight, 0.0F) / (1.0F - below);
}

/// Adds a vertex between its ends and its sample, lowered by the earth's curvature.
inline std::uint32_t BisectionMesher::add_vertex(const NewVertex& made) {
    const std::uint32_t vertex = vertex_count_++;
    const auto east_m = static_cast<float>(criterion_.west_m() + made.at.column * ground_->spacing_m());
    const auto north_m = static_cast<float>(criterion_.south_m() + made.at.row * ground_->spacing_m());
    float height_m =
        static_cast<float>(height_base_m_ + ground_->shape().height_unit_m * static_cast<double>(made.height));
    height_m -= criterion_.drop_m(east_m, north_m);
    if (made.weight < 1.0F) {
        const float from_a = vertices_[made.parent_a].position_m.z;
        const float from_b = vertices_[made.parent_b].position_m.z;
        const float middle_m = 0.5F * (from_a + from_b);
        height_m += (1.0F - made.weight) * (middle_m - height_m);
    }
    vertices_[vertex] = {{east_m, north_m, height_m}, 0};
    morphs_[vertex] = {static_cast<std::uint16_t>(std::min(made.at.column, ground_->columns() - 1)),
        static_cast<std::uint16_t>(std::min(made.at.row, ground_->rows() - 1)), made.parent_a, made.parent_b,
        made.weight};
    return vertex;
}

/// Whether a quadrant is drawn by a child.
bool BisectionMesher::is_drawn(const BisectionNode& node, unsigned quadrant) const {
    return node.quadrant[quadrant] < limit_ && (unsigned{node.hidden} >> quadrant & 1U) == 0;
}

/// Puts a node's triangles, and those of all nodes below it, into the mesh.
void BisectionMesher::emit(EmittedFan& fan) {
    const BisectionNode& node = nodes_[fan.node];
    const LevelReader& memory = criterion_.memory(node.level);
    const FanSamples samples(*ground_, memory.edge(), node.column, node.row);
    const LevelReader::NodeSlot slot = memory.slot(node.column, node.row);
    if (fan.node != root_node) { add_centre(samples, memory.centre_height(slot), fan); }
    unsigned middles = 0;
    unsigned split = 0;
    for (unsigned k = 0; k < 4; ++k) {
        middles |= node.middle[k] < limit_ ? 1U << k : 0U;
        split |= node.quadrant[k] < limit_ ? 1U << k : 0U;
    }
    add_midpoints(samples, slot, middles, fan);
    const unsigned covered = split | node.hidden;
    const unsigned children = split & ~unsigned{node.hidden};
    const GridSample centre = samples.padded(1, 1);
    const glm::dvec2 eye = eye_ - glm::dvec2(centre.column, centre.row);
    const PartOrder& order = orders_[wedge_containing(eye.x, eye.y)];
    const unsigned triangles = order.triangles(middles, covered);
    const std::size_t before = index_count_;
    triangle_ranges_[fan.node].first = static_cast<std::uint32_t>(before / 3);
    const bool is_cut = samples.is_cut();
    if (is_cut) { reserve_border(); }
    for (unsigned left = triangles | order.children[children]; left != 0; left &= left - 1) {
        const unsigned part = order.part[static_cast<std::size_t>(std::countr_zero(left))];
        if (is_cut && part < first_child_part) {
            emit_part_within_border(fan, samples, part);
        } else {
            emit_part(fan, part);
        }
    }
    counters_.fans += is_cut ? (index_count_ > before ? 1 : 0) : (triangles != 0 ? 1 : 0);
    triangle_ranges_[fan.node].end = static_cast<std::uint32_t>(index_count_ / 3);
    drawn_heights_[fan.node] = fan.heights;
}

inline void BisectionMesher::add_height(std::uint32_t vertex, DrawnHeights& heights) const {
    const float z_m = vertices_[vertex].position_m.z;
    heights.lowest_m = std::min(heights.lowest_m, z_m);
    heights.highest_m = std::max(heights.highest_m, z_m);
}

/// Puts one part of a fan into the mesh: a triangle, or the fan of a child.
inline void BisectionMesher::emit_part(EmittedFan& fan, unsigned part) {
    if (part >= first_child_part) {
        EmittedFan child = child_of(fan, part - first_child_part);
        emit(child);
        fan.heights.lowest_m = std::min(fan.heights.lowest_m, child.heights.lowest_m);
        fan.heights.highest_m = std::max(fan.heights.highest_m, child.heights.highest_m);
        return;
    }
    std::uint32_t* const corner = indices_.data() + index_count_;
    corner[0] = fan.ring[centre_of_ring];
    corner[1] = fan.ring[part_sides[part].from];
    corner[2] = fan.ring[part_sides[part].to];
    for (std::size_t k = 0; k < 3; ++k) { add_height(corner[k], fan.heights); }
    index_count_ += 3;
}

/// Reserves memory for the additions at the border to one node: three triangles for one, and their corners.
void BisectionMesher::reserve_border() {
    ++cut_nodes_;
    const std::size_t count = nodes_.size();
    if (indices_.size() < 24 * count + 48 * cut_nodes_) { indices_.resize(30 * count + 96 * cut_nodes_); }
    if (vertices_.size() < 5 * count + 4 + 32 * cut_nodes_) {
        vertices_.resize(6 * count + 4 + 64 * cut_nodes_);
        morphs_.resize(std::max(morphs_.size(), vertices_.size()));
    }
}

/// Puts what the field's border leaves of a triangle of a fan into the mesh.
void BisectionMesher::emit_part_within_border(EmittedFan& fan, const FanSamples& samples, unsigned part) {
    const auto corner = [&](std::size_t place) {
        const std::uint32_t vertex = fan.ring[place];
        return ClipVertex{samples.padded_ring(place), vertices_[vertex].position_m.z, vertex};
    };
    ClippedPolygon left = clip_to_border(
        {corner(centre_of_ring), corner(part_sides[part].from), corner(part_sides[part].to)}, samples.last());
    if (left.count < 3) { return; }
    for (unsigned k = 0; k < left.count; ++k) {
        if (left.corner[k].vertex == ClipVertex::no_vertex) { left.corner[k].vertex = border_vertex(left.corner[k]); }
        add_height(left.corner[k].vertex, fan.heights);
    }
    // Back to front: a line from the first corner separates adjacent triangles.
    const glm::dvec2 first(left.corner[0].at.column, left.corner[0].at.row);
    std::array<unsigned, 3> order = {2, 2, 2};
    for (unsigned k = 3; k < left.count; ++k) {
        const GridSample& between = left.corner[k - 1].at;
        const glm::dvec2 line = glm::dvec2(between.column, between.row) - first;
        const glm::dvec2 eye = eye_ - first;
        order[k - 2] = k;
        if (line.x * eye.y - line.y * eye.x <= 0.0) {
            std::rotate(order.begin(), order.begin() + k - 2, order.begin() + k - 1);
        }
    }
    for (unsigned n = 0; n + 2 < left.count; ++n) {
        const unsigned k = order[view_.order == PaintOrder::BackToFront ? n : left.count - 3 - n];
        indices_[index_count_++] = left.corner[0].vertex;
        indices_[index_count_++] = left.corner[k - 1].vertex;
        indices_[index_count_++] = left.corner[k].vertex;
    }
}

/// The vertex where the border crosses an edge.
std::uint32_t BisectionMesher::border_vertex(const ClipVertex& corner) {
    const auto rows = static_cast<std::size_t>(ground_->rows());
    const bool eastern = corner.at.column == ground_->columns() - 1;
    BorderVertex& known = border_vertices_[eastern ? static_cast<std::size_t>(corner.at.row)
                                                   : rows + static_cast<std::size_t>(corner.at.column)];
    if (known.mesh != mesh_number_) {
        known = {mesh_number_, fixed_vertex(corner.at, 0)};
        vertices_[known.vertex].position_m.z = corner.height;
    }
    return known.vertex;
}

/// The fan of a child, which takes its corners from its parent.
BisectionMesher::EmittedFan BisectionMesher::child_of(const EmittedFan& fan, unsigned quadrant) {
    const BisectionNode& node = nodes_[fan.node];
    EmittedFan child;
    child.node = node.child[quadrant];
    for (std::size_t k = 0; k < 4; ++k) { child.ring[2 * k] = fan.ring[child_corners[quadrant][k]]; }
    const std::array<std::uint8_t, 4>& inner = inner_edges[quadrant];
    for (const unsigned k : {0U, 1U, 2U, 3U}) {
        const unsigned across = quadrant ^ (k % 2 == 0 ? 2U : 1U);
        const BisectionNode& holder = nodes_[inner[k] != 0 ? fan.node : fan.beyond[k]];
        child.beyond[k] = holder.child[across];
    }
    child.parent_a = fan.ring[centre_of_ring];
    child.parent_b = fan.ring[ring_of_quadrant[quadrant]];
    return child;
}

/// Adds the vertex of a fan's centre.
inline void BisectionMesher::add_centre(const FanSamples& samples, std::int16_t height, EmittedFan& fan) {
    const BisectionNode& node = nodes_[fan.node];
    const float weight =
        weight_of(node.node_limit, [&] { return criterion_.share_below_centre(node.level, node.column, node.row); });
    const NewVertex made{samples.padded(1, 1), fan.parent_a, fan.parent_b, height, weight};
    fan.ring[centre_of_ring] = add_vertex(made);
}

/// Adds the mid-points next to visible quadrants, and passes them to the nodes beyond the edges.
inline void BisectionMesher::add_midpoints(
    const FanSamples& samples, const LevelReader::NodeSlot& slot, unsigned middles, EmittedFan& fan) {
    const BisectionNode& node = nodes_[fan.node];
    const Four& known = middle_vertex_[fan.node];
    unsigned missing = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        fan.ring[2 * k + 1] = known[k];
        missing |= (known[k] == 0 ? 1U : 0U) << k;
    }
    for (unsigned left = missing & middles & edges_of_visible[node.hidden]; left != 0; left &= left - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(left));
        const std::int16_t height = criterion_.memory(node.level).middle_height(slot, node.column, node.row, k);
        const std::uint32_t vertex = add_midpoint(samples, height, fan, k);
        fan.ring[2 * k + 1] = vertex;
        middle_vertex_[fan.beyond[k]][(k + 2) % 4] = vertex;
    }
}

inline std::uint32_t BisectionMesher::add_midpoint(
    const FanSamples& samples, std::int16_t height, const EmittedFan& fan, std::size_t edge) {
    const BisectionNode& node = nodes_[fan.node];
    const float weight = weight_of(
        node.middle[edge], [&] { return criterion_.share_below_middle(node.level, node.column, node.row, edge); });
    return add_vertex(
        {samples.padded_ring(2 * edge + 1), fan.ring[2 * edge], fan.ring[(2 * edge + 2) % 8], height, weight});
}

// Which triangles of a mesh lie in some box, such as around an aircraft whose shadow they receive or which they may
// hide. A node's triangles and those of all nodes below it follow one another in the mesh, so that whole subtrees are
// accepted or skipped by the box around what is drawn.

void BisectionMesher::triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const {
    if (has_mesh_) { add_triangles_in(root_node, wanted, triangles); }
}

/// The children of a node that are drawn; 0 for the others.
BisectionMesher::Four BisectionMesher::drawn_children(const BisectionNode& node) const {
    Four children = node.child;
    for (unsigned q = 0; q < 4; ++q) { children[q] = is_drawn(node, q) ? children[q] : 0; }
    return children;
}

void BisectionMesher::add_triangles_in(
    std::uint32_t own, const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const {
    const BisectionNode& node = nodes_[own];
    const FanSamples samples(*ground_, ground_->layout().level(node.level).edge, node.column, node.row);
    const GridSample min = samples.at(0, 0);
    const GridSample max = samples.at(2, 2);
    const glm::dvec2 half_m = ground_->half_extent_m();
    const glm::dvec2 west_south = glm::dvec2(min.column, min.row) * ground_->spacing_m() - half_m;
    const glm::dvec2 east_north = glm::dvec2(max.column, max.row) * ground_->spacing_m() - half_m;
    if (triangle_ranges_[own].first == triangle_ranges_[own].end ||
        !wanted({west_south, static_cast<double>(drawn_heights_[own].lowest_m) + view_.eye_m.z},
            {east_north, static_cast<double>(drawn_heights_[own].highest_m) + view_.eye_m.z})) {
        return;
    }
    for_each_in_range(
        triangle_ranges_[own], drawn_children(node), [&](std::uint32_t child) { return triangle_ranges_[child]; },
        [&](std::uint32_t triangle) { triangles.push_back(triangle); },
        [&](std::uint32_t child) { add_triangles_in(child, wanted, triangles); });
}

} // namespace octant::visuals::terrain
