// Triangle fans of a restricted quadtree: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that Minimize
// Flickering Effect", equations (1) and (3) and steps 3 and 4 of section 2; fans after S. Roettger, W. Heidrich, P.
// Slusallek, H.-P. Seidel, "Real-Time Generation of Continuous Levels of Detail for Height Fields".
//
// Step 3 walks down the tree from the root and collects the nodes that are split (QuadtreeSelection, add()); step 4
// emits a full or partial fan for each of them (emit()). A fan leaves out the mid-points of edges beyond which the
// neighbour is coarser, so that there are no cracks.
//
// Deviations:
// - Triangles come in painting order (paint_order.cpp). The paper draws with a depth buffer.
// - An edge keeps its mid-point where this node has a child at it; otherwise where the node
//   beyond the edge is in the mesh, or would be but for the frustum; and always at the field's
//   border.
// - QuadtreeCriterion states those of equation (3).
#include "visuals/terrain/quadtree_mesher.h"

#include "visuals/terrain/budget_search.h"
#include "visuals/terrain/fan_triangles.h"
#include "visuals/terrain/frustum.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace octant::visuals::terrain {

// Which nodes of the restricted quadtree split: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that Minimize
// Flickering Effect", equations (1) and (3).
//
// Deviations:
// - Equation (3), f = l / (d C max(c d2, 1)) < 1, is evaluated as C > l / (d max(c d2, 1)), with
//   both sides squared. The right side belongs to the node and the view alone, so that the C of
//   every step of N(C) is known.
// - l is sqrt(dx^2 + dy^2 + (eye's height above the ground below it)^2), with dx, dy to the node's
//   centre. The third part is the same for all nodes, so that l changes by no more than the
//   distance between two centres and splitting is monotone down the tree.
// - The root is always in the mesh, whatever its f.
// - C is raised to the tree's smallest and multiplied by the view's magnification.

namespace {

/// More than the rounding of heights in double precision can amount to.
constexpr double height_margin_m = 1e-6;

} // namespace

QuadtreeCriterion::QuadtreeCriterion(const Quadtree& tree) : tree_(&tree) {
    for (int level = 0; level < tree.levels(); ++level) {
        const auto edge = static_cast<float>(tree.edge_samples(level));
        levels_.push_back({tree.edge_samples(level), tree.columns(level), tree.rows(level), edge, 0.5F * edge});
    }
}

void QuadtreeCriterion::set_view(const MeshView& view, const QuadtreeDetail& detail) {
    assert(view.magnification >= 1.0);
    assert(detail.roughness_weight >= 0.0 && detail.roughness_weight < 1e6);
    const models::heights::HeightField& field = tree_->field();
    const glm::dvec2 half_m = field.half_extent_m();
    const double ground_m =
        field.height_at(std::clamp(view.eye_m.x, -half_m.x, half_m.x), std::clamp(view.eye_m.y, -half_m.y, half_m.y))
            .value_or(0.0);
    view_ = view;
    west_m_ = -half_m.x - view.eye_m.x;
    south_m_ = -half_m.y - view.eye_m.y;
    eye_column_ = static_cast<float>(-west_m_ / field.spacing_m());
    eye_row_ = static_cast<float>(-south_m_ / field.spacing_m());
    const double height = std::max(view.eye_m.z - ground_m, 0.0) / field.spacing_m();
    eye_height_squared_ = static_cast<float>(height * height);
    fan_kind_ = detail.fans;
    roughness_weight_ = static_cast<float>(detail.roughness_weight);
}

double QuadtreeCriterion::resolution_of(float limit) const {
    return std::max(std::sqrt(static_cast<double>(limit)) / view_.magnification, tree_->options().min_resolution);
}

std::array<float, 4> QuadtreeCriterion::critical_squared_of_four(int level, int column, int row) const {
    std::array<float, 4> critical{};
    if (fan_kind_ == FanKind::Full) {
        critical.fill(critical_squared(level, column, row));
        return critical;
    }
    const Level& at = levels_[static_cast<std::size_t>(level)];
    const std::size_t east = column + 1 < at.columns ? 1 : 0;
    const std::size_t north = row + 1 < at.rows ? static_cast<std::size_t>(at.columns) : 0;
    const QuadtreeNode* first = tree_->nodes().data() + node_at(level, column, row);
    const std::array<float, 4> roughness = {roughness_of(first[0]), roughness_of(first[east]),
        roughness_of(first[north]), roughness_of(first[north + east])};
    for (unsigned q = 0; q < 4; ++q) {
        critical[q] =
            critical_squared_at(at, column + static_cast<int>(q & 1U), row + static_cast<int>(q >> 1U), roughness[q]);
    }
    return critical;
}

NodeBox QuadtreeCriterion::box_of(const GroundFan& node) const {
    const models::heights::HeightField& field = tree_->field();
    const QuadtreeNode& bounds = tree_->nodes()[node.node];
    const int edge = levels_[node.level].edge;
    const int west = node.column * edge;
    const int south = node.row * edge;
    NodeBox box{field.sample_m(west, south),
        field.sample_m(std::min(west + edge, field.columns() - 1), std::min(south + edge, field.rows() - 1))};
    box.min_m.z = tree_->lowest_m(bounds) - height_margin_m;
    box.max_m.z = tree_->highest_m(bounds) + height_margin_m;
    return box;
}

unsigned QuadtreeCriterion::crossed_planes_of_node(const GroundFan& node, unsigned planes) const {
    const NodeBox box = box_of(node);
    return crossed_planes(
        view_.frustum_normals, planes, 0.5 * (box.min_m + box.max_m) - view_.eye_m, 0.5 * (box.max_m - box.min_m));
}

// The resolution C that spends a budget of triangles, exactly and in the frame in which it is spent: equations (1) and
// (3) of E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that Minimize Flickering Effect", solved for C. Each
// node has a critical C above which it is in the mesh; N(C) is a sum of steps at these values, and the largest C within
// the budget is read off.
//
// Deviation: this replaces section 3 of the paper, which steers C by the triangles of earlier frames, equations (4) and
// (5).

namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();
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

float QuadtreeSelection::limit_for(const QuadtreeCriterion& criterion, const TriangleBudget& budget) {
    assert(budget.triangles >= 1);
    criterion_ = &criterion;
    nodes_tested_ = 0;
    const float last = last_resolution_ > 0.0 ? criterion.limit_squared(last_resolution_) : 0.0F;
    const CountSearch search{budget.triangles, criterion.limit_squared(0.0),
        criterion.limit_squared(budget.max_resolution), last, first_look};
    const float found = find_limit(
        search, steps_, [&](float low, float high, int max_triangles) { return walk(low, high, max_triangles); });
    last_resolution_ = criterion.resolution_of(found);
    return found;
}

void QuadtreeSelection::collect(const QuadtreeCriterion& criterion, float limit) {
    criterion_ = &criterion;
    nodes_tested_ = 0;
    walk(limit, limit, std::numeric_limits<int>::max());
}

/// Walks the tree and collects nodes and steps below `high`. Returns whether there is more above it.
bool QuadtreeSelection::walk(float low, float high, int max_triangles) {
    nodes_.clear();
    steps_.start(low, high);
    high_ = high;
    max_triangles_ = max_triangles;
    has_steps_above_ = false;
    PendingNode root;
    root.planes = active_planes(criterion_->view().frustum_normals);
    visit(root);
    return has_steps_above_;
}

/// Collects a node and the nodes below it.
void QuadtreeSelection::visit(const PendingNode& from) {
    if (steps_.at_high() > max_triangles_) { return; }
    SelectedNode node;
    node.fan = from.fan;
    node.node_limit = from.node_limit;
    node.split.fill(unbounded);
    std::array<unsigned, 4> planes{};
    if (from.fan.level + 1 < tree_->levels()) { test_quadrants(from, node, planes); }
    for (std::size_t k = 0; k < 4; ++k) {
        const FanEdge& edge = fan_edges[k];
        node.middle[k] = std::min({from.beyond[k], node.split[edge.quadrant_a], node.split[edge.quadrant_b]});
    }
    const FanSamples samples(tree_->field(), criterion_->level(node.fan.level).edge, node.fan.column, node.fan.row);
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
        if ((unsigned{node.fan.hidden} >> q & 1U) != 0) { continue; }
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

/// Fills in the limits at which the quadrants split, which of them are hidden, and which frustum planes their boxes may
/// reach beyond.
void QuadtreeSelection::test_quadrants(const PendingNode& from, SelectedNode& node, std::array<unsigned, 4>& planes) {
    const int level = from.fan.level + 1;
    const QuadtreeCriterion::Level& at = criterion_->level(level);
    const std::array<float, 4> critical =
        criterion_->critical_squared_of_four(level, 2 * from.fan.column, 2 * from.fan.row);
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
            child.node = criterion_->node_at(level, child.column, child.row);
            planes[q] = criterion_->crossed_planes_of_node(child, from.planes);
            node.fan.hidden |= planes[q] == outside_frustum ? bit : std::uint8_t{0};
        }
    }
}

/// The visit to a child; planes and replaced triangles are left to the caller.
QuadtreeSelection::PendingNode QuadtreeSelection::child_pending(
    const PendingNode& from, const SelectedNode& node, unsigned quadrant) const {
    PendingNode next;
    next.fan = child_of(from.fan, quadrant);
    const int column = next.fan.column;
    const int row = next.fan.row;
    next.fan.node = criterion_->node_at(next.fan.level, column, row);
    next.node_limit = node.split[quadrant];
    const bool east = (quadrant & 1U) != 0;
    const bool north = (quadrant & 2U) != 0;
    const QuadtreeCriterion::Level& at = criterion_->level(next.fan.level);
    next.beyond[east ? 3 : 1] = east || column + 1 < at.columns ? node.split[quadrant ^ 1U] : 0.0F;
    next.beyond[north ? 0 : 2] = north || row + 1 < at.rows ? node.split[quadrant ^ 2U] : 0.0F;
    const std::size_t side = east ? 1 : 3;
    next.beyond[side] = neighbour_limit(from.beyond[side], next.fan.level, column + (east ? 1 : -1), row);
    const std::size_t end = north ? 2 : 0;
    next.beyond[end] = neighbour_limit(from.beyond[end], next.fan.level, column, row + (north ? 1 : -1));
    return next;
}

/// The limit above which a neighbouring node is in the mesh; 0 where the field ends there. `parent` is the limit of
/// that node's parent.
float QuadtreeSelection::neighbour_limit(float parent, int level, int column, int row) const {
    const QuadtreeCriterion::Level& at = criterion_->level(level);
    if (column < 0 || row < 0 || column >= at.columns || row >= at.rows) { return 0.0F; }
    if (parent >= high_) { return unbounded; }
    return std::max(parent, criterion_->critical_squared(level, column, row));
}

QuadtreeMesher::QuadtreeMesher(const Quadtree& tree, std::span<const std::uint32_t> colours)
    : tree_(&tree), criterion_(tree), selection_(tree) {
    set_colours(colours);
    assert(tree.levels() <= 16);
}

void QuadtreeMesher::set_colours(std::span<const std::uint32_t> colours) {
    assert(colours.size() ==
           static_cast<std::size_t>(tree_->field().columns()) * static_cast<std::size_t>(tree_->field().rows()));
    colours_ = colours;
}

GroundMesh QuadtreeMesher::mesh(const MeshView& view, const QuadtreeDetail& detail) {
    collect(view, detail, nullptr);
    return counted_mesh();
}

GroundMesh QuadtreeMesher::mesh_within(
    const MeshView& view, const QuadtreeDetail& detail, const TriangleBudget& budget) {
    collect(view, detail, &budget);
    return counted_mesh();
}

CountedMesh QuadtreeMesher::count(const MeshView& view, const QuadtreeDetail& detail) {
    collect(view, detail, nullptr);
    return count_fans();
}

CountedMesh QuadtreeMesher::count_within(
    const MeshView& view, const QuadtreeDetail& detail, const TriangleBudget& budget) {
    collect(view, detail, &budget);
    return count_fans();
}

/// Fills fans_ with the nodes of the mesh at the C of `detail`, or at the largest C that a budget allows.
void QuadtreeMesher::collect(const MeshView& view, const QuadtreeDetail& detail, const TriangleBudget* budget) {
    criterion_.set_view(view, detail);
    if (budget != nullptr) {
        limit_ = selection_.limit_for(criterion_, *budget);
        resolution_ = criterion_.resolution_of(limit_);
    } else {
        limit_ = criterion_.limit_squared(detail.resolution);
        resolution_ = std::max(detail.resolution, tree_->options().min_resolution);
        selection_.collect(criterion_, limit_);
    }
    fans_.clear();
    fan_records_.clear();
    counters_ = {};
    counters_.nodes_visited = selection_.nodes_tested();
    is_collected_ = true;
    orders_ = painting_orders(view.order).data();
    eye_ = glm::dvec2(-criterion_.west_m(), -criterion_.south_m()) / tree_->field().spacing_m();
    for (const SelectedNode& node : selection_.nodes()) {
        if (node.node_limit < limit_) { add(node); }
    }
}

/// Adds a node that is in the mesh to fans_, after its parent.
void QuadtreeMesher::add(const SelectedNode& node) {
    GroundFan fan = node.fan;
    unsigned middles = 0;
    for (unsigned k = 0; k < 4; ++k) {
        fan.split |= static_cast<std::uint8_t>(node.split[k] < limit_ ? 1U << k : 0U);
        middles |= node.middle[k] < limit_ ? 1U << k : 0U;
    }
    last_fan_of_level_[fan.level] = static_cast<std::uint32_t>(fans_.size());
    if (fan.level > 0) {
        const unsigned quadrant = (fan.column & 1U) | (fan.row & 1U) << 1U;
        fan_records_[last_fan_of_level_[fan.level - 1U]].child[quadrant] = last_fan_of_level_[fan.level];
    }
    fans_.push_back(fan);
    fan_records_.emplace_back().middles = static_cast<std::uint8_t>(middles);
}

GroundMesh QuadtreeMesher::counted_mesh() {
    assert(is_collected_);
    is_collected_ = false;
    reserve();
    emit(0, nullptr, 0);
    counters_.triangles = static_cast<int>(index_count_ / 3);
    return {std::span(vertices_).first(vertex_count_), std::span(indices_).first(index_count_), counters_, resolution_,
        0.0, {}};
}

// Puts the collected fans into the mesh as triangles, in painting order (step 4 there), and finds triangles again by
// the boxes of their nodes.

namespace {

/// For each place of a fan's ring and centre the place whose vertex it takes, where the middle column was moved onto
/// the eastern one (odd rows) and the middle row onto the northern one (the last two rows).
constexpr std::array<std::array<std::uint8_t, 9>, 4> coinciding_places = {{{0, 1, 2, 3, 4, 5, 6, 7, 8},
    {0, 2, 2, 3, 4, 4, 6, 7, 3}, {0, 1, 2, 4, 4, 5, 6, 6, 5}, {0, 2, 2, 4, 4, 4, 6, 6, 4}}};

} // namespace

/// Reserves memory for five vertices and eight triangles for each fan and for the root's corners, and resets the
/// counts.
void QuadtreeMesher::reserve() {
    const std::size_t fans = fans_.size();
    const std::size_t max_vertices = 5 * fans + 4;
    if (vertices_.size() < max_vertices) { vertices_.resize(max_vertices + max_vertices / 4); }
    if (indices_.size() < 24 * fans) { indices_.resize(30 * fans); }
    vertex_count_ = 0;
    index_count_ = 0;
    counters_.fans = 0;
}

CountedMesh QuadtreeMesher::count_fans() {
    counters_.triangles = 0;
    counters_.fans = 0;
    for (std::size_t own = 0; own < fans_.size(); ++own) {
        const unsigned triangles = triangle_count_of(own);
        counters_.triangles += static_cast<int>(triangles);
        counters_.fans += triangles != 0 ? 1 : 0;
    }
    return {counters_, resolution_};
}

/// How many triangles a node has of its own.
unsigned QuadtreeMesher::triangle_count_of(std::size_t own) const {
    const GroundFan& fan = fans_[own];
    const unsigned covered = fan.split | fan.hidden;
    const FanSamples samples(tree_->field(), criterion_.level(fan.level).edge, fan.column, fan.row);
    if (!samples.is_cut()) {
        return static_cast<unsigned>(std::popcount(orders_[0].triangles(fan_records_[own].middles, covered)));
    }
    const PartList row = parts_of_cut_fan(
        samples, parts_of(fan_records_[own].middles, covered, 0), glm::dvec2(0.0), criterion_.view().order);
    return row.count;
}

/// Puts a node's triangles, and those of all nodes below it, into the mesh.
void QuadtreeMesher::emit(std::uint32_t own, EmittedFan* parent, unsigned quadrant) {
    const GroundFan& fan = fans_[own];
    FanRecord& place = fan_records_[own];
    place.triangles.first = static_cast<std::uint32_t>(index_count_ / 3);
    const unsigned covered = fan.split | fan.hidden;
    const unsigned children = fan.split & ~unsigned{fan.hidden};
    const FanSamples samples(tree_->field(), criterion_.level(fan.level).edge, fan.column, fan.row);
    const GridSample centre = samples.at(1, 1);
    const glm::dvec2 eye = eye_ - glm::dvec2(centre.column, centre.row);
    const unsigned coinciding = (samples.columns_coincide() ? 1U : 0U) | (samples.rows_coincide() ? 2U : 0U);
    EmittedFan emitted{samples, own, quadrant, parent,
        parent == nullptr ? std::array<std::uint32_t, 4>{} : fans_beyond(*parent, quadrant),
        coinciding_places[coinciding].data(), {}};
    emitted.vertex.fill(no_vertex);
    if (samples.is_cut()) {
        const PartList row =
            parts_of_cut_fan(samples, parts_of(place.middles, covered, children), eye, criterion_.view().order);
        bool any = false;
        for (unsigned k = 0; k < row.count; ++k) {
            emit_part(emitted, row.part[k]);
            any = any || row.part[k] < first_child_part;
        }
        counters_.fans += any ? 1 : 0;
    } else {
        const PartOrder& order = orders_[wedge_containing(eye.x, eye.y)];
        const unsigned triangles = order.triangles(place.middles, covered);
        counters_.fans += triangles != 0 ? 1 : 0;
        for (unsigned left = triangles | order.children[children]; left != 0; left &= left - 1) {
            emit_part(emitted, order.part[static_cast<std::size_t>(std::countr_zero(left))]);
        }
    }
    place.triangles.end = static_cast<std::uint32_t>(index_count_ / 3);
}

/// Puts one part of a fan into the mesh: a triangle, or the fan of a child.
inline void QuadtreeMesher::emit_part(EmittedFan& fan, unsigned part) {
    if (part >= first_child_part) {
        const unsigned quadrant = part - first_child_part;
        emit(fan_records_[fan.own].child[quadrant], &fan, quadrant);
        return;
    }
    std::uint32_t* const corner = indices_.data() + index_count_;
    corner[0] = vertex_of(fan, centre_of_ring);
    corner[1] = vertex_of(fan, part_sides[part].from);
    corner[2] = vertex_of(fan, part_sides[part].to);
    index_count_ += 3;
}

/// The fans beyond the edges of a child's fan: brothers, or children of those beyond the parent.
inline std::array<std::uint32_t, 4> QuadtreeMesher::fans_beyond(const EmittedFan& parent, unsigned quadrant) const {
    std::array<std::uint32_t, 4> beyond{};
    for (unsigned k = 0; k < 4; ++k) {
        const bool is_inner = inner_edges[quadrant][k] != 0;
        const std::uint32_t holder = is_inner ? parent.own : parent.beyond[k];
        const unsigned across = quadrant ^ (k % 2 == 0 ? 2U : 1U);
        beyond[k] = is_inner || holder != 0 ? fan_records_[holder].child[across] : 0;
    }
    return beyond;
}

/// The vertex of a place of a fan's ring, or of its centre; a new one if the mesh has none there yet.
std::uint32_t QuadtreeMesher::vertex_of(EmittedFan& fan, std::size_t place) {
    place = fan.place_of[place];
    std::uint32_t& vertex = fan.vertex[place];
    if (vertex == no_vertex) {
        if (place == centre_of_ring) {
            vertex = add_vertex(fan.samples.ring(place));
        } else if (place % 2 != 0) {
            vertex = middle_vertex(fan, place / 2);
        } else if (fan.parent != nullptr) {
            vertex = vertex_of(*fan.parent, child_corners[fan.quadrant][place / 2]);
        } else {
            vertex = add_vertex(fan.samples.ring(place));
        }
    }
    return vertex;
}

/// The vertex of the mid-point of an edge, which is also passed to the fan beyond the edge.
std::uint32_t QuadtreeMesher::middle_vertex(const EmittedFan& fan, std::size_t edge) {
    std::uint32_t& vertex = fan_records_[fan.own].middle[edge];
    if (vertex == no_vertex) {
        vertex = add_vertex(fan.samples.ring(2 * edge + 1));
        if (fan.beyond[edge] != 0) { fan_records_[fan.beyond[edge]].middle[(edge + 2) % 4] = vertex; }
    }
    return vertex;
}

/// Adds the vertex of a sample.
inline std::uint32_t QuadtreeMesher::add_vertex(GridSample at) {
    const models::heights::HeightField& field = tree_->field();
    const double height_m = static_cast<double>(field.height_m(at.column, at.row));
    const std::ptrdiff_t sample = static_cast<std::ptrdiff_t>(at.row) * field.columns() + at.column;
    vertices_[vertex_count_] = {glm::vec3(static_cast<float>(criterion_.west_m() + at.column * field.spacing_m()),
                                    static_cast<float>(criterion_.south_m() + at.row * field.spacing_m()),
                                    static_cast<float>(height_m - criterion_.view().eye_m.z)),
        colours_[static_cast<std::size_t>(sample)]};
    return vertex_count_++;
}

void QuadtreeMesher::triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const {
    if (!fans_.empty()) { add_triangles_in(0, wanted, triangles); }
}

void QuadtreeMesher::add_triangles_in(
    std::uint32_t own, const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const {
    const NodeBox box = criterion_.box_of(fans_[own]);
    if (!wanted(box.min_m, box.max_m)) { return; }
    const unsigned drawn = fans_[own].split & ~unsigned{fans_[own].hidden};
    std::array<std::uint32_t, 4> children = fan_records_[own].child;
    for (unsigned q = 0; q < 4; ++q) { children[q] = (drawn >> q & 1U) != 0 ? children[q] : 0; }
    for_each_in_range(
        fan_records_[own].triangles, children, [&](std::uint32_t child) { return fan_records_[child].triangles; },
        [&](std::uint32_t triangle) { triangles.push_back(triangle); },
        [&](std::uint32_t child) { add_triangles_in(child, wanted, triangles); });
}

// Searches over N(C), for the first picture and for studies.

double resolution_for_target(QuadtreeMesher& mesher, const MeshView& view, const QuadtreeDetail& detail,
    double target_triangles, double max_resolution) {
    double low = mesher.tree().options().min_resolution;
    double high = std::max(max_resolution, low);
    double best = low;
    double best_miss = std::numeric_limits<double>::infinity();
    const auto too_many = [&](double resolution) {
        QuadtreeDetail tried = detail;
        tried.resolution = resolution;
        const double over = mesher.count(view, tried).counters.triangles - target_triangles;
        if (std::abs(over) < best_miss) {
            best_miss = std::abs(over);
            best = resolution;
        }
        return over > 0.0;
    };
    if (too_many(low) || !too_many(high)) { return best; }
    for (int step = 0; step < 22 && best_miss > 0.0; ++step) {
        const double middle = std::sqrt(low * high);
        (too_many(middle) ? high : low) = middle;
    }
    return best;
}

double triangle_count_slope(QuadtreeMesher& mesher, const MeshView& view, const QuadtreeDetail& detail) {
    constexpr double share = 0.02;
    QuadtreeDetail nearby_detail = detail;
    nearby_detail.resolution = detail.resolution * (1.0 + share);
    const int more = mesher.count(view, nearby_detail).counters.triangles;
    nearby_detail.resolution = detail.resolution * (1.0 - share);
    const int fewer = mesher.count(view, nearby_detail).counters.triangles;
    return (more - fewer) / (2.0 * share * detail.resolution);
}

} // namespace octant::visuals::terrain
