// Half-edges for collapses and flips. CollapsibleMesh::effect_of tests the link condition of T. Dey, H. Edelsbrunner,
// S. Guha, D. Nekhayev, "Topology Preserving Edge Contraction", 1999: the ends of the edge may have no common
// neighbours but the corners opposite the edge. The 2005 paper tests nothing and so leaves manifolds; its own mode uses
// PaperRun instead.
#include "models/simplify/collapsible_mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace octant::models::simplify {

CollapsibleMesh::CollapsibleMesh(std::size_t vertices, std::span<const Triangle> triangles)
    : twins_(triangles.size() * 3, none), outgoing_(vertices, none), face_count_(triangles.size()),
      marks_(vertices, 0) {
    origins_.reserve(triangles.size() * 3);
    for (const Triangle& triangle : triangles) { origins_.insert(origins_.end(), triangle.begin(), triangle.end()); }
    // All half-edges are listed by the smaller vertex of their edge (counting sort), and those of each vertex by the
    // larger one, so that twins follow each other.
    std::vector<std::uint32_t> starts(vertices + 1, 0);
    const auto low = [this](HalfEdge h) { return std::min(origin(h), target(h)); };
    for (HalfEdge h = 0; h < origins_.size(); ++h) { ++starts[low(h) + 1]; }
    for (std::size_t v = 0; v < vertices; ++v) { starts[v + 1] += starts[v]; }
    std::vector<HalfEdge> listed(origins_.size());
    std::vector<std::uint32_t> places = starts;
    for (HalfEdge h = 0; h < origins_.size(); ++h) { listed[places[low(h)]++] = h; }
    const auto high = [this](HalfEdge h) { return std::max(origin(h), target(h)); };
    for (std::size_t v = 0; v < vertices; ++v) {
        const std::span<HalfEdge> here(listed.data() + starts[v], starts[v + 1] - starts[v]);
        std::ranges::sort(here, {}, [&](HalfEdge h) { return std::pair(high(h), h); });
        for (std::size_t i = 1; i < here.size(); ++i) {
            const HalfEdge a = here[i - 1];
            const HalfEdge b = here[i];
            if (high(a) == high(b)) {
                assert(origin(a) == target(b) && twins_[a] == none);
                twins_[a] = b;
                twins_[b] = a;
            }
        }
    }
    for (HalfEdge h = 0; h < origins_.size(); ++h) {
        if (outgoing_[origin(h)] == none || twins_[h] == none) { outgoing_[origin(h)] = h; }
    }
    assert(is_vertex_manifold());
    vertex_count_ = static_cast<std::size_t>(std::ranges::count_if(outgoing_, [](HalfEdge h) { return h != none; }));
}

/// Whether walking around each vertex visits all triangles there.
bool CollapsibleMesh::is_vertex_manifold() const {
    std::vector<std::size_t> corners(outgoing_.size(), 0);
    for (const std::uint32_t vertex : origins_) { ++corners[vertex]; }
    for (std::uint32_t vertex = 0; vertex < outgoing_.size(); ++vertex) {
        if (outgoing_[vertex] != none) {
            around(vertex, [&](HalfEdge) { --corners[vertex]; });
        }
    }
    return std::ranges::all_of(corners, [](std::size_t left) { return left == 0; });
}

bool CollapsibleMesh::is_neighbour(std::uint32_t vertex, std::uint32_t other) const {
    bool found = false;
    edges_around(vertex, [&](HalfEdge h) { found = found || origin(h) == other || target(h) == other; });
    return found;
}

CollapseEffect CollapsibleMesh::effect_of(HalfEdge h, TopologyChanges allowed) const {
    const std::uint32_t u = origin(h);
    const std::uint32_t w = target(h);
    const HalfEdge other = twins_[h];
    // An ear has two boundary edges; collapsing its third edge would leave a lone edge.
    const auto is_ear = [this](HalfEdge side) {
        return twins_[next_of(side)] == none && twins_[previous_of(side)] == none;
    };
    if (is_ear(h) || (other != none && is_ear(other))) { return {}; }
    const std::uint32_t x = origin(previous_of(h));
    const std::uint32_t y = other == none ? none : origin(previous_of(other));
    if (x == y || (other != none && is_boundary_vertex(u) && is_boundary_vertex(w))) { return {}; }
    ++mark_;
    const auto far_end = [this](HalfEdge e, std::uint32_t v) { return origin(e) == v ? target(e) : origin(e); };
    std::size_t u_edges = 0;
    edges_around(u, [&](HalfEdge e) {
        marks_[far_end(e, u)] = mark_;
        ++u_edges;
    });
    marks_[x] = mark_ - 1;
    if (y != none) { marks_[y] = mark_ - 1; }
    std::size_t common = 0;
    std::size_t w_edges = 0;
    std::uint32_t third = none;
    edges_around(w, [&](HalfEdge e) {
        if (marks_[far_end(e, w)] == mark_) {
            third = far_end(e, w);
            ++common;
        }
        ++w_edges;
    });
    // A lone tetrahedron would become two triangles on top of each other.
    if (common > 1 || (u_edges == 3 && w_edges == 3 && (other != none || common == 1))) { return {}; }
    if (common == 0) { return {CollapseEffect::Kind::SameTopology}; }
    const auto needed = other == none ? TopologyChanges::Holes : TopologyChanges::HolesAndHandles;
    return allowed < needed ? CollapseEffect{} : effect_on_cycle(h, third);
}

/// effect_of() where `c` is the only common neighbour that is not opposite the edge.
CollapseEffect CollapsibleMesh::effect_on_cycle(HalfEdge h, std::uint32_t c) const {
    const std::uint32_t u = origin(h);
    const std::uint32_t w = target(h);
    if (twins_[h] == none) {
        const HalfEdge second = outgoing_[w];
        const HalfEdge third = outgoing_[c];
        const bool goes_around = twins_[third] == none && target(second) == c && target(third) == u;
        return goes_around ? CollapseEffect{CollapseEffect::Kind::ClosesHole, second, third} : CollapseEffect{};
    }
    CollapseEffect effect{CollapseEffect::Kind::CutsHandle};
    around(c, [&](HalfEdge e) {
        effect.second = target(e) == w ? twins_[e] : effect.second;
        effect.third = target(e) == u ? e : effect.third;
    });
    if (free_vertex_slot_ == none || has_vertex(free_vertex_slot_) || effect.second == none || effect.third == none ||
        twins_[effect.third] == none || !is_connected_without({h, effect.second, effect.third})) {
        return {};
    }
    return effect;
}

/// Whether one can go from left to right of a cycle of edges without crossing it. Both sides are searched in turns, so
/// that a small part that the cycle cuts off is soon searched.
bool CollapsibleMesh::is_connected_without(const std::array<HalfEdge, 3>& cycle) const {
    face_marks_.resize(face_slots(), 0);
    face_mark_ += 2;
    std::array<std::vector<std::uint32_t>, 2> found;
    for (const HalfEdge h : cycle) {
        for (const std::uint32_t side : {0U, 1U}) {
            const std::uint32_t face = face_of(side == 0 ? h : twins_[h]);
            if (face_marks_[face] < face_mark_) {
                face_marks_[face] = face_mark_ + side;
                found[side].push_back(face);
            } else if (face_marks_[face] != face_mark_ + side) {
                return true;
            }
        }
    }
    for (std::size_t i = 0; i < found[0].size() && i < found[1].size(); ++i) {
        for (const std::uint32_t side : {0U, 1U}) {
            for (HalfEdge h = 3 * found[side][i]; h < 3 * found[side][i] + 3; ++h) {
                const HalfEdge beyond = twins_[h];
                if (beyond == none || std::ranges::find(cycle, h) != cycle.end() ||
                    std::ranges::find(cycle, beyond) != cycle.end()) {
                    continue;
                }
                std::uint32_t& mark = face_marks_[face_of(beyond)];
                if (mark < face_mark_) {
                    mark = face_mark_ + side;
                    found[side].push_back(face_of(beyond));
                } else if (mark != face_mark_ + side) {
                    return true;
                }
            }
        }
    }
    return false;
}

void CollapsibleMesh::ring_of(HalfEdge h, std::vector<RingFace>& ring) const {
    ring.clear();
    const std::uint32_t left = face_of(h);
    const std::uint32_t right = twins_[h] == none ? none : face_of(twins_[h]);
    const auto add = [&](HalfEdge e) {
        const std::uint32_t face = face_of(e);
        if (face != left && face != right) { ring.push_back({face, e}); }
    };
    around(origin(h), add);
    around(target(h), add);
}

void CollapsibleMesh::ring_at(
    std::uint32_t vertex, std::vector<RingFace>& ring, std::vector<std::uint32_t>& faces) const {
    ring.clear();
    faces.clear();
    around(vertex, [&](HalfEdge h) {
        ring.push_back({face_of(h), h});
        faces.push_back(face_of(h));
    });
}

/// Makes two half-edges each other's twins; either may be none.
void CollapsibleMesh::join(HalfEdge a, HalfEdge b) {
    if (a != none) { twins_[a] = b; }
    if (b != none) { twins_[b] = a; }
}

/// Sets the half-edge by which walks around origin(h) start: `h`, turned clockwise as far as the boundary if there is
/// one.
void CollapsibleMesh::set_outgoing(HalfEdge h) {
    const HalfEdge first = h;
    while (twins_[h] != none) {
        h = next_of(twins_[h]);
        if (h == first) { break; }
    }
    outgoing_[origins_[first]] = h;
}

/// Removes the triangle of `h` and joins its two other edges.
void CollapsibleMesh::take_out(HalfEdge h) {
    const HalfEdge a = twins_[next_of(h)];
    const HalfEdge b = twins_[previous_of(h)];
    const std::uint32_t face = face_of(h);
    join(a, b);
    for (std::uint32_t i = 0; i < 3; ++i) {
        origins_[face * 3 + i] = none;
        twins_[face * 3 + i] = none;
    }
    --face_count_;
}

/// Gives the fan of triangles in which `h` starts to another vertex.
void CollapsibleMesh::set_fan_vertex(HalfEdge h, std::uint32_t vertex) {
    const std::uint32_t before = origin(h);
    set_outgoing(h);
    around(before, [&](HalfEdge e) { origins_[e] = vertex; });
    outgoing_[vertex] = outgoing_[before];
}

CollapseEffect CollapsibleMesh::collapse(HalfEdge h) {
    CollapseEffect effect = effect_of(h, TopologyChanges::HolesAndHandles);
    assert(effect.kind != CollapseEffect::Kind::NotAllowed);
    const std::uint32_t u = origin(h);
    const std::uint32_t w = target(h);
    const HalfEdge other = twins_[h];
    [[maybe_unused]] const std::uint32_t x = origin(previous_of(h));
    const std::uint32_t y = other == none ? none : origin(previous_of(other));
    // Half-edges that stay, outside of the two triangles: to enter u, x and y by.
    const HalfEdge wx = twins_[next_of(h)];     // x -> w
    const HalfEdge xu = twins_[previous_of(h)]; // u -> x
    const HalfEdge uy = other == none ? none : twins_[next_of(other)];
    const HalfEdge yw = other == none ? none : twins_[previous_of(other)];
    around(w, [this, u](HalfEdge e) { origins_[e] = u; });
    take_out(h);
    if (other != none) { take_out(other); }
    outgoing_[w] = none;
    --vertex_count_;
    if (effect.kind == CollapseEffect::Kind::ClosesHole) {
        join(effect.second, effect.third);
        set_outgoing(effect.third);
    } else if (effect.kind == CollapseEffect::Kind::CutsHandle) {
        const HalfEdge right_second = twins_[effect.second]; // c -> w
        const HalfEdge right_third = twins_[effect.third];   // u -> c
        join(effect.second, effect.third);
        join(right_second, right_third);
        effect.made = free_vertex_slot_;
        set_fan_vertex(right_third, w);
        set_fan_vertex(right_second, effect.made);
        set_outgoing(effect.second);
        set_outgoing(effect.third);
        vertex_count_ += 2;
    }
    if (outgoing_[w] == none) { free_vertex_slot_ = w; }
    set_outgoing(xu != none ? xu : next_of(wx));
    set_outgoing(wx != none ? wx : next_of(xu));
    assert(origins_[xu != none ? xu : next_of(wx)] == u);
    assert(origins_[wx != none ? wx : next_of(xu)] == x);
    if (y != none) {
        set_outgoing(uy != none ? uy : next_of(yw));
        assert(origins_[uy != none ? uy : next_of(yw)] == y);
    }
    return effect;
}

void CollapsibleMesh::split(HalfEdge h, std::uint32_t vertex, const std::array<std::uint32_t, 2>& faces) {
    assert(!has_vertex(vertex) && !has_face(faces[0]) && !has_face(faces[1]));
    const HalfEdge other = twins_[h];
    const std::uint32_t w = target(h);
    const HalfEdge a = 3 * faces[0]; // From the new vertex to w.
    const HalfEdge b = 3 * faces[1]; // From w to the new vertex.
    const HalfEdge wx = next_of(h);
    const HalfEdge yw = previous_of(other);
    const HalfEdge beyond_wx = twins_[wx];
    origins_[a] = vertex;
    origins_[a + 1] = w;
    origins_[a + 2] = origin(previous_of(h));
    origins_[wx] = vertex;
    origins_[b] = w;
    origins_[b + 1] = vertex;
    origins_[b + 2] = origin(yw);
    origins_[other] = vertex;
    join(a + 1, beyond_wx);
    join(wx, a + 2);
    join(b + 2, twins_[yw]);
    join(b + 1, yw);
    join(a, b);
    face_count_ += 2;
    ++vertex_count_;
    for (const HalfEdge start : {a, a + 1, previous_of(h), h, yw}) { set_outgoing(start); }
}

void CollapsibleMesh::remove(std::uint32_t face) {
    for (HalfEdge h = 3 * face; h < 3 * face + 3; ++h) {
        if (outgoing_[origins_[h]] != none) {
            outgoing_[origins_[h]] = none;
            --vertex_count_;
        }
        origins_[h] = none;
        twins_[h] = none;
    }
    --face_count_;
}

SlotMap CollapsibleMesh::compact() {
    SlotMap kept;
    std::vector<std::uint32_t> new_vertices(vertex_slots(), none);
    for (std::uint32_t vertex = 0; vertex < vertex_slots(); ++vertex) {
        if (has_vertex(vertex)) {
            new_vertices[vertex] = static_cast<std::uint32_t>(kept.vertices.size());
            kept.vertices.push_back(vertex);
        }
    }
    std::vector<std::uint32_t> new_faces(face_slots(), none);
    for (std::uint32_t face = 0; face < face_slots(); ++face) {
        if (has_face(face)) {
            new_faces[face] = static_cast<std::uint32_t>(kept.faces.size());
            kept.faces.push_back(face);
        }
    }
    const auto moved = [&](HalfEdge h) { return h == none ? none : 3 * new_faces[face_of(h)] + h % 3; };
    for (HalfEdge to = 0; to < 3 * kept.faces.size(); ++to) {
        const HalfEdge from = 3 * kept.faces[face_of(to)] + to % 3;
        origins_[to] = new_vertices[origins_[from]];
        twins_[to] = moved(twins_[from]);
    }
    for (std::vector<std::uint32_t>* list : {&origins_, &twins_}) {
        list->resize(3 * kept.faces.size());
        list->shrink_to_fit();
    }
    compact_slots(outgoing_, kept.vertices);
    for (HalfEdge& out : outgoing_) { out = moved(out); }
    marks_.assign(vertex_slots(), 0);
    marks_.shrink_to_fit();
    mark_ = 0;
    face_marks_.clear();
    face_mark_ = 0;
    free_vertex_slot_ = none;
    return kept;
}

bool CollapsibleMesh::may_flip(HalfEdge h) const {
    const HalfEdge other = twins_[h];
    if (other == none) { return false; }
    const std::uint32_t x = origin(previous_of(h));
    const std::uint32_t y = origin(previous_of(other));
    return x != y && !is_neighbour(x, y);
}

void CollapsibleMesh::flip(HalfEdge h) {
    const HalfEdge o = twins_[h];
    const HalfEdge h1 = next_of(h);
    const HalfEdge h2 = previous_of(h);
    const HalfEdge o1 = next_of(o);
    const HalfEdge o2 = previous_of(o);
    const std::uint32_t u = origins_[h];
    const std::uint32_t w = origins_[o];
    const std::uint32_t x = origins_[h2];
    const std::uint32_t y = origins_[o2];
    const HalfEdge wx = twins_[h1];
    const HalfEdge xu = twins_[h2];
    const HalfEdge uy = twins_[o1];
    const HalfEdge yw = twins_[o2];
    // Triangle of h: y -> x -> u; triangle of o: x -> y -> w.
    origins_[h] = y;
    origins_[h1] = x;
    origins_[h2] = u;
    origins_[o] = x;
    origins_[o1] = y;
    origins_[o2] = w;
    join(h, o);
    join(h1, xu);
    join(h2, uy);
    join(o1, yw);
    join(o2, wx);
    set_outgoing(h1);
    set_outgoing(h2);
    set_outgoing(o1);
    set_outgoing(o2);
}

} // namespace octant::models::simplify
