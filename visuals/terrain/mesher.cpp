// Triangle fans of a restricted quadtree: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method
// that Minimize Flickering Effect", equations (1) and (3) and steps 3 and 4 of section 2; fans
// after S. Roettger, W. Heidrich, P. Slusallek, H.-P. Seidel, "Real-Time Generation of Continuous
// Levels of Detail for Height Fields".
//
// Step 3 walks down the tree from the root and collects the nodes that are split (visit, add); step
// 4 emits a full or partial fan for each of them (emit). A fan leaves out the mid-points of edges
// beyond which the neighbour is coarser, so that there are no cracks.
//
// Deviations:
// - Triangles come in painting order (paint_order.cpp). The paper draws with a depth buffer.
// - An edge keeps its mid-point where this node has a child beside it; otherwise where the node
//   beyond the edge is in the mesh, or would be but for the frustum; and always at the field's
//   border.
// - Those of equation (3) are stated in split_rule.cpp.
#include "visuals/terrain/mesher.h"

#include "visuals/terrain/frustum.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

namespace octant::visuals::terrain {

namespace {

/// For each place of a fan's ring and centre the place whose vertex it takes, where the middle
/// column was moved onto the eastern one (odd rows) and the middle row onto the northern one (the
/// last two rows).
constexpr std::array<std::array<std::uint8_t, 9>, 4> coinciding_places = {
    {{0, 1, 2, 3, 4, 5, 6, 7, 8},
     {0, 2, 2, 3, 4, 4, 6, 7, 3},
     {0, 1, 2, 4, 4, 5, 6, 6, 5},
     {0, 2, 2, 4, 4, 4, 6, 6, 4}}};

} // namespace

Mesher::Mesher(const Quadtree& tree, std::span<const std::uint32_t> colours)
    : tree_(&tree)
    , colours_(colours)
    , rule_(tree)
    , survey_(tree)
    , in_mesh_(tree.nodes().size(), 0) {
    assert(
        colours.size() == static_cast<std::size_t>(tree.field().columns()) *
                              static_cast<std::size_t>(tree.field().rows()));
    assert(tree.levels() <= 16);
}

GroundMesh Mesher::mesh(const MeshView& view, const Detail& detail) {
    rule_.look_from(view, detail);
    limit_ = rule_.limit_squared(detail.resolution);
    start(view);
    visit({}, planes_of(view.frustum_normals));
    for (std::size_t k = 0; k < fans_.size(); ++k) {
        places_[k].middles = static_cast<std::uint8_t>(middles_of(fans_[k]));
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
    start(view);
    counters_.nodes_visited = survey_.nodes_tested();
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
        add(fan, middles);
    }
    return finished(rule_.resolution_of(limit_));
}

/// Prepares for a new mesh.
void Mesher::start(const MeshView& view) {
    fans_.clear();
    places_.clear();
    counters_ = {};
    orders_ = painting_orders(view.order).data();
    eye_ = glm::dvec2(-rule_.west_m(), -rule_.south_m()) / tree_->field().spacing_m();
}

/// Adds a node that is in the mesh to fans_, after its parent. Returns its index.
std::size_t Mesher::add(const GroundFan& fan, unsigned middles) {
    const std::size_t own = fans_.size();
    newest_[fan.level] = static_cast<std::uint32_t>(own);
    if (fan.level > 0) {
        const unsigned quadrant = (fan.column & 1U) | (fan.row & 1U) << 1U;
        places_[newest_[fan.level - 1U]].child[quadrant] = newest_[fan.level];
    }
    fans_.push_back(fan);
    places_.emplace_back().middles = static_cast<std::uint8_t>(middles);
    return own;
}

/// Makes the mesh of fans_.
GroundMesh Mesher::finished(double resolution) {
    make_room();
    emit(0, nullptr, 0);
    counters_.triangles = static_cast<int>(index_count_ / 3);
    return {
        std::span(vertices_).first(vertex_count_),
        std::span(indices_).first(index_count_),
        counters_,
        resolution,
        0.0,
        {}};
}

/// Whether a node is in the unculled mesh: it and all of its ancestors are switched on.
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

/// Adds a node and all nodes that are split below it to fans_. `planes` are the frustum planes that
/// the node's box may reach beyond.
void Mesher::visit(GroundFan fan, unsigned planes) {
    fan.at_frustum = planes != 0;
    in_mesh_[fan.node] = 1;
    const std::size_t own = add(fan, 0);
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

/// Makes room for five vertices and eight triangles for each fan, and for the root's corners.
void Mesher::make_room() {
    const std::size_t fans = fans_.size();
    const std::size_t most_vertices = 5 * fans + 4;
    if (vertices_.size() < most_vertices) {
        vertices_.resize(most_vertices + most_vertices / 4);
    }
    if (indices_.size() < 24 * fans) {
        indices_.resize(30 * fans);
    }
    vertex_count_ = 0;
    index_count_ = 0;
}

/// Whether the node beyond an edge is in the mesh, or the field ends there.
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

/// The set of edges that have a mid-point, as bits by fan_edges.
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

/// Puts a node's triangles, and those of all nodes below it, into the mesh.
void Mesher::emit(std::uint32_t own, EmittedFan* parent, unsigned quadrant) {
    const GroundFan& fan = fans_[own];
    FanPlace& place = places_[own];
    place.triangles.first = static_cast<std::uint32_t>(index_count_ / 3);
    const unsigned covered = fan.split | fan.hidden;
    const unsigned children = fan.split & ~unsigned{fan.hidden};
    const FanSamples samples(tree_->field(), rule_.level(fan.level).edge, fan.column, fan.row);
    const Sample centre = samples.at(1, 1);
    const glm::dvec2 eye = eye_ - glm::dvec2(centre.column, centre.row);
    const unsigned coinciding =
        (samples.columns_coincide() ? 1U : 0U) | (samples.rows_coincide() ? 2U : 0U);
    EmittedFan emitted{
        samples,
        own,
        quadrant,
        parent,
        parent == nullptr ? std::array<std::uint32_t, 4>{} : fans_beyond(*parent, quadrant),
        coinciding_places[coinciding].data(),
        {}};
    emitted.vertex.fill(no_vertex);
    if (samples.is_cut()) {
        const PartRow row = parts_of_cut_fan(
            samples, parts_of(place.middles, covered, children), eye, rule_.view().order);
        bool any = false;
        for (unsigned k = 0; k < row.count; ++k) {
            emit_part(emitted, row.part[k]);
            any = any || row.part[k] < first_child_part;
        }
        counters_.fans += any ? 1 : 0;
    } else {
        const PartOrder& order = orders_[wedge_towards(eye.x, eye.y)];
        const unsigned triangles = order.triangles(place.middles, covered);
        counters_.fans += triangles != 0 ? 1 : 0;
        for (unsigned left = triangles | order.children[children]; left != 0; left &= left - 1) {
            emit_part(emitted, order.part[static_cast<std::size_t>(std::countr_zero(left))]);
        }
    }
    place.triangles.end = static_cast<std::uint32_t>(index_count_ / 3);
}

/// Puts one part of a fan into the mesh: a triangle, or the fan of a child.
inline void Mesher::emit_part(EmittedFan& fan, unsigned part) {
    if (part >= first_child_part) {
        const unsigned quadrant = part - first_child_part;
        emit(places_[fan.own].child[quadrant], &fan, quadrant);
        return;
    }
    std::uint32_t* const corner = indices_.data() + index_count_;
    corner[0] = vertex_of(fan, centre_of_ring);
    corner[1] = vertex_of(fan, part_sides[part].from);
    corner[2] = vertex_of(fan, part_sides[part].to);
    index_count_ += 3;
}

/// The fans beyond the edges of a child's fan: brothers, or children of those beyond the parent.
inline std::array<std::uint32_t, 4>
Mesher::fans_beyond(const EmittedFan& parent, unsigned quadrant) const {
    std::array<std::uint32_t, 4> beyond{};
    for (unsigned k = 0; k < 4; ++k) {
        const bool is_inner = inner_edges[quadrant][k] != 0;
        const std::uint32_t holder = is_inner ? parent.own : parent.beyond[k];
        const unsigned across = quadrant ^ (k % 2 == 0 ? 2U : 1U);
        beyond[k] = is_inner || holder != 0 ? places_[holder].child[across] : 0;
    }
    return beyond;
}

/// The vertex of a place of a fan's ring, or of its centre; a new one if the mesh has none there
/// yet.
std::uint32_t Mesher::vertex_of(EmittedFan& fan, std::size_t place) {
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

/// The vertex of the mid-point of an edge, of which the fan beyond the edge is told.
std::uint32_t Mesher::middle_vertex(const EmittedFan& fan, std::size_t edge) {
    std::uint32_t& vertex = places_[fan.own].middle[edge];
    if (vertex == no_vertex) {
        vertex = add_vertex(fan.samples.ring(2 * edge + 1));
        if (fan.beyond[edge] != 0) {
            places_[fan.beyond[edge]].middle[(edge + 2) % 4] = vertex;
        }
    }
    return vertex;
}

/// Adds the vertex of a sample.
inline std::uint32_t Mesher::add_vertex(Sample at) {
    const models::heights::HeightField& field = tree_->field();
    const double height_m = static_cast<double>(field.height_m(at.column, at.row));
    const std::ptrdiff_t sample = static_cast<std::ptrdiff_t>(at.row) * field.columns() + at.column;
    vertices_[vertex_count_] = {
        glm::vec3(
            static_cast<float>(rule_.west_m() + at.column * field.spacing_m()),
            static_cast<float>(rule_.south_m() + at.row * field.spacing_m()),
            static_cast<float>(height_m - rule_.view().eye_m.z)),
        colours_[static_cast<std::size_t>(sample)]};
    return vertex_count_++;
}

void Mesher::triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const {
    if (!fans_.empty()) {
        add_triangles_in(0, wanted, triangles);
    }
}

void Mesher::add_triangles_in(
    std::uint32_t own, const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const {
    const NodeBox box = rule_.box_of(fans_[own]);
    if (!wanted(box.least_m, box.most_m)) {
        return;
    }
    const unsigned drawn = fans_[own].split & ~unsigned{fans_[own].hidden};
    std::array<std::uint32_t, 4> children = places_[own].child;
    for (unsigned q = 0; q < 4; ++q) {
        children[q] = (drawn >> q & 1U) != 0 ? children[q] : 0;
    }
    for_each_in_run(
        places_[own].triangles,
        children,
        [&](std::uint32_t child) { return places_[child].triangles; },
        [&](std::uint32_t triangle) { triangles.push_back(triangle); },
        [&](std::uint32_t child) { add_triangles_in(child, wanted, triangles); });
}

} // namespace octant::visuals::terrain
