// Puts the fans that mesher.cpp has collected into the mesh as triangles, in painting order (step 4 there), and finds
// triangles again by the boxes of their nodes.
#include "visuals/terrain/quadtree_mesher.h"

#include <glm/vec2.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::terrain {

namespace {

/// For each place of a fan's ring and centre the place whose vertex it takes, where the middle column was moved onto
/// the eastern one (odd rows) and the middle row onto the northern one (the last two rows).
constexpr std::array<std::array<std::uint8_t, 9>, 4> coinciding_places = {{{0, 1, 2, 3, 4, 5, 6, 7, 8},
    {0, 2, 2, 3, 4, 4, 6, 7, 3}, {0, 1, 2, 4, 4, 5, 6, 6, 5}, {0, 2, 2, 4, 4, 4, 6, 6, 4}}};

} // namespace

/// Makes room for five vertices and eight triangles for each fan, and for the root's corners, and begins to count them.
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
    const FanSamples samples(tree_->field(), rule_.level(fan.level).edge, fan.column, fan.row);
    if (!samples.is_cut()) {
        return static_cast<unsigned>(std::popcount(orders_[0].triangles(fan_records_[own].middles, covered)));
    }
    const PartList row =
        parts_of_cut_fan(samples, parts_of(fan_records_[own].middles, covered, 0), glm::dvec2(0.0), rule_.view().order);
    return row.count;
}

/// Puts a node's triangles, and those of all nodes below it, into the mesh.
void QuadtreeMesher::emit(std::uint32_t own, EmittedFan* parent, unsigned quadrant) {
    const GroundFan& fan = fans_[own];
    FanRecord& place = fan_records_[own];
    place.triangles.first = static_cast<std::uint32_t>(index_count_ / 3);
    const unsigned covered = fan.split | fan.hidden;
    const unsigned children = fan.split & ~unsigned{fan.hidden};
    const FanSamples samples(tree_->field(), rule_.level(fan.level).edge, fan.column, fan.row);
    const GridSample centre = samples.at(1, 1);
    const glm::dvec2 eye = eye_ - glm::dvec2(centre.column, centre.row);
    const unsigned coinciding = (samples.columns_coincide() ? 1U : 0U) | (samples.rows_coincide() ? 2U : 0U);
    EmittedFan emitted{samples, own, quadrant, parent,
        parent == nullptr ? std::array<std::uint32_t, 4>{} : fans_beyond(*parent, quadrant),
        coinciding_places[coinciding].data(), {}};
    emitted.vertex.fill(no_vertex);
    if (samples.is_cut()) {
        const PartList row =
            parts_of_cut_fan(samples, parts_of(place.middles, covered, children), eye, rule_.view().order);
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

/// The vertex of the mid-point of an edge, of which the fan beyond the edge is told.
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
    vertices_[vertex_count_] = {glm::vec3(static_cast<float>(rule_.west_m() + at.column * field.spacing_m()),
                                    static_cast<float>(rule_.south_m() + at.row * field.spacing_m()),
                                    static_cast<float>(height_m - rule_.view().eye_m.z)),
        colours_[static_cast<std::size_t>(sample)]};
    return vertex_count_++;
}

void QuadtreeMesher::triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const {
    if (!fans_.empty()) { add_triangles_in(0, wanted, triangles); }
}

void QuadtreeMesher::add_triangles_in(
    std::uint32_t own, const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const {
    const NodeBox box = rule_.box_of(fans_[own]);
    if (!wanted(box.min_m, box.max_m)) { return; }
    const unsigned drawn = fans_[own].split & ~unsigned{fans_[own].hidden};
    std::array<std::uint32_t, 4> children = fan_records_[own].child;
    for (unsigned q = 0; q < 4; ++q) { children[q] = (drawn >> q & 1U) != 0 ? children[q] : 0; }
    for_each_in_range(
        fan_records_[own].triangles, children, [&](std::uint32_t child) { return fan_records_[child].triangles; },
        [&](std::uint32_t triangle) { triangles.push_back(triangle); },
        [&](std::uint32_t child) { add_triangles_in(child, wanted, triangles); });
}

} // namespace octant::visuals::terrain
