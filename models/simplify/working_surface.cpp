// Conversion between files and working units, and from the mesh that is being changed back to a TriangleMesh.
//
// is_valid_deformation keeps steps from folding the surface over: the test of the angle between old and new normal of
// M. Garland and P. Heckbert (1997). Slivers are allowed where the error allows them: along cylinders and rims they lie
// best. The topology has a test of its own, CollapsibleMesh::may_collapse.
//
// OriginalSurface finds the nearest point of a triangle by the regions of C. Ericson, "Real-Time Collision Detection",
// 2005, section 5.1.5.
#include "models/simplify/working_surface.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace octant::models::simplify {

// Half-edges for collapses and flips. CollapsibleMesh::may_collapse tests the link condition of T. Dey, H.
// Edelsbrunner, S. Guha, D. Nekhayev, "Topology Preserving Edge Contraction", 1999: the ends of the edge may have no
// common neighbours but the corners opposite the edge. The 2005 paper tests nothing and so leaves manifolds; its own
// mode uses PaperRun instead.

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

namespace {

/// Where the squared share of its sides' rectangle that a triangle covers is below this, rounding hides on which side
/// of it a point lies; the nearest point of its sides is taken then.
constexpr double min_area_share2 = 1e-12;

} // namespace

OriginalSurface::OriginalSurface(const WorkingSurface& surface, const TriangleMesh& made_of, const WorkingUnits& units)
    : mesh_(made_of), units_(units), places_(surface.places) {
    const CollapsibleMesh& mesh = surface.mesh;
    neighbours_.reserve(mesh.face_slots());
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        std::array<std::uint32_t, 3>& beyond = neighbours_.emplace_back();
        for (std::uint32_t side = 0; side < 3; ++side) {
            const HalfEdge twin = mesh.twin(3 * face + side);
            beyond[side] = twin == none ? none : face_of(twin);
        }
    }
}

const std::shared_ptr<const measure::TriangleBvh>& OriginalSurface::tree() const {
    if (!tree_) { tree_ = std::make_shared<const measure::TriangleBvh>(mesh_); }
    return tree_;
}

measure::NearestOnMesh OriginalSurface::nearest(const glm::dvec3& place) const {
    measure::NearestOnMesh found = tree()->nearest(units_.to_file(place));
    found.point = units_.from_file(found.point);
    found.distance2 /= units_.diagonal_m * units_.diagonal_m;
    return found;
}

glm::dvec3 OriginalSurface::normal(std::uint32_t triangle) const {
    const auto [a, b, c] = mesh_.triangles[triangle];
    return area_vector({places_[a], places_[b], places_[c]});
}

OriginalSurface::OnTriangle OriginalSurface::nearest_on(std::uint32_t triangle, const glm::dvec3& point) const {
    const Triangle& t = mesh_.triangles[triangle];
    const glm::dvec3& a = places_[t[0]];
    const glm::dvec3 ab = places_[t[1]] - a;
    const glm::dvec3 ac = places_[t[2]] - a;
    const glm::dvec3 ap = point - a;
    const double d1 = glm::dot(ab, ap);
    const double d2 = glm::dot(ac, ap);
    const auto made = [&](const glm::dvec3& from_a, std::uint32_t side, std::uint32_t corner) {
        const glm::dvec3 off = ap - from_a;
        return OnTriangle{a + from_a, glm::dot(off, off), side, corner};
    };
    if (d1 <= 0.0 && d2 <= 0.0) { return made(glm::dvec3(0.0), none, 0); }
    const double bb = glm::dot(ab, ab);
    const double bc = glm::dot(ab, ac);
    const double cc = glm::dot(ac, ac);
    const double d3 = d1 - bb;
    const double d4 = d2 - bc;
    if (d3 >= 0.0 && d4 <= d3) { return made(ab, none, 1); }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) { return made((bb > 0.0 ? d1 / bb : 0.0) * ab, 0, none); }
    const double d5 = d1 - bc;
    const double d6 = d2 - cc;
    if (d6 >= 0.0 && d5 <= d6) { return made(ac, none, 2); }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) { return made((cc > 0.0 ? d2 / cc : 0.0) * ac, 2, none); }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double length = (d4 - d3) + (d5 - d6);
        const double along = length > 0.0 ? (d4 - d3) / length : 0.0;
        return made(ab + along * (ac - ab), 1, none);
    }
    const double sum = va + vb + vc;
    if (!(sum > min_area_share2 * bb * cc)) {
        const auto on_side = [&](std::uint32_t side, const glm::dvec3& from, const glm::dvec3& way) {
            const double length2 = glm::dot(way, way);
            const double along = glm::dot(ap - from, way);
            const bool ends = !(along > 0.0 && along < length2);
            const std::uint32_t corner = along > 0.0 ? (side + 1) % 3 : side;
            const double share = ends ? (along > 0.0 ? 1.0 : 0.0) : along / length2;
            return made(from + share * way, ends ? none : side, ends ? corner : none);
        };
        const OnTriangle sides[] = {on_side(0, glm::dvec3(0.0), ab), on_side(1, ab, ac - ab), on_side(2, ac, -ac)};
        return *std::ranges::min_element(sides, {}, &OnTriangle::distance2);
    }
    return made((vb / sum) * ab + (vc / sum) * ac, none, none);
}

OriginalPoint OriginalSurface::nearest_from(std::uint32_t start, const glm::dvec3& point, double& distance2) const {
    std::uint32_t at = start;
    OnTriangle best = nearest_on(at, point);
    while (true) {
        std::uint32_t next = none;
        OnTriangle nearer;
        const auto look = [&](std::uint32_t triangle) {
            const OnTriangle here = nearest_on(triangle, point);
            const double least2 = next == none ? best.distance2 : nearer.distance2;
            if (here.distance2 < least2) {
                nearer = here;
                next = triangle;
            }
        };
        if (best.side != none && neighbours_[at][best.side] != none) {
            look(neighbours_[at][best.side]);
        } else if (best.corner != none) {
            // Around the corner, first one way and at a boundary then the other way.
            const std::uint32_t corner = mesh_.triangles[at][best.corner];
            for (const bool forward : {true, false}) {
                std::uint32_t triangle = at;
                do {
                    std::uint32_t i = 0;
                    while (mesh_.triangles[triangle][i] != corner) { ++i; }
                    triangle = neighbours_[triangle][forward ? (i + 2) % 3 : i];
                    if (triangle != none && triangle != at) { look(triangle); }
                } while (triangle != none && triangle != at);
                if (triangle == at) { break; }
            }
        }
        if (next == none) {
            distance2 = best.distance2;
            return {measure::narrow(best.place), at};
        }
        best = nearer;
        at = next;
    }
}

bool is_valid_deformation(const std::array<glm::dvec3, 3>& before, const std::array<glm::dvec3, 3>& after) {
    const glm::dvec3 old_normal = area_vector(before);
    const glm::dvec3 new_normal = area_vector(after);
    if (!(glm::dot(new_normal, new_normal) > 0.0)) { return false; }
    return !(glm::dot(old_normal, old_normal) > 0.0) || glm::dot(old_normal, new_normal) > 0.0;
}

bool may_flip_to(
    const std::array<std::array<glm::dvec3, 3>, 2>& before, const std::array<std::array<glm::dvec3, 3>, 2>& after) {
    return std::ranges::all_of(before, [&](const auto& from) {
        return std::ranges::all_of(after, [&](const auto& to) { return is_valid_deformation(from, to); });
    });
}

bool may_move(const WorkingSurface& surface, std::span<const RingFace> ring, const glm::dvec3& place) {
    return std::ranges::all_of(ring, [&](const RingFace& face) {
        const glm::dvec3& old_place = surface.places[surface.mesh.origin(face.half_edge)];
        return is_valid_deformation(moved_corners(surface, face, old_place), moved_corners(surface, face, place));
    });
}

WorkingUnits WorkingUnits::of(const TriangleMesh& mesh, double colour_weight) {
    // Colours that do not count are carried along with this weight.
    constexpr double min_weight = 1e-4;
    const BoundingBox bounds = bounds_of(mesh);
    const double diagonal_m = glm::distance(bounds.min_m, bounds.max_m);
    return {
        0.5 * (bounds.min_m + bounds.max_m), diagonal_m > 0.0 ? diagonal_m : 1.0, std::max(colour_weight, min_weight)};
}

glm::vec3 WorkingUnits::colour_to_file(const glm::dvec3& colour) const {
    return glm::clamp(glm::vec3(colour / colour_scale), glm::vec3(0.0F), glm::vec3(1.0F));
}

std::vector<glm::dvec3> WorkingUnits::places_of(const TriangleMesh& mesh) const {
    std::vector<glm::dvec3> places;
    places.reserve(mesh.vertices_m.size());
    for (const glm::dvec3& vertex_m : mesh.vertices_m) { places.push_back(from_file(vertex_m)); }
    return places;
}

std::vector<glm::dvec3> WorkingUnits::colours_of(const TriangleMesh& mesh) const {
    std::vector<glm::dvec3> colours;
    colours.reserve(mesh.colours.size());
    for (const glm::vec3& colour : mesh.colours) { colours.push_back(glm::dvec3(colour) * colour_scale); }
    return colours;
}

WorkingSurface::WorkingSurface(const TriangleMesh& from, const WorkingUnits& units)
    : mesh(from.vertices_m.size(), from.triangles), places(units.places_of(from)), colours(units.colours_of(from)),
      materials(from.triangle_materials) {}

bool WorkingSurface::is_border_vertex(std::uint32_t vertex) const {
    if (mesh.is_boundary_vertex(vertex)) { return true; }
    bool found = false;
    if (!materials.empty()) {
        mesh.around(vertex, [&](HalfEdge h) { found = found || is_material_border(h); });
    }
    return found;
}

void WorkingSurface::lock_border(const TriangleMesh& from, const WorkingUnits& units) {
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_slots(); ++vertex) {
        if (mesh.has_vertex(vertex) && mesh.is_boundary_vertex(vertex)) {
            const glm::dvec3 place = units.from_file(from.vertices_m[vertex]);
            locked_m[{place.x, place.y, place.z}] = from.vertices_m[vertex];
        }
    }
}

glm::dvec3 WorkingSurface::to_file(const glm::dvec3& place, const WorkingUnits& units) const {
    const auto locked = locked_m.find({place.x, place.y, place.z});
    return locked == locked_m.end() ? units.to_file(place) : locked->second;
}

glm::dvec3 WorkingSurface::along_borders(std::uint32_t vertex, const glm::dvec3& way) const {
    if (is_locked(vertex)) { return glm::dvec3(0.0); }
    if (materials.empty() && !mesh.is_boundary_vertex(vertex)) { return way; }
    constexpr double straight = -0.5; // The cosine between two borders that go on as one.
    glm::dvec3 normal(0.0);
    std::array<glm::dvec3, 2> borders;
    std::size_t count = 0;
    mesh.edges_around(vertex, [&](HalfEdge h) {
        normal += area_vector(corner_places(face_of(h)));
        if (is_border(h)) {
            const std::uint32_t other = mesh.origin(h) == vertex ? mesh.target(h) : mesh.origin(h);
            const glm::dvec3 border = places[other] - places[vertex];
            const double length = glm::length(border);
            borders[count % 2] = length > 0.0 ? border / length : border;
            ++count;
        }
    });
    const double length = glm::length(normal);
    if (count == 0 || !(length > 0.0)) { return way; }
    normal /= length;
    const glm::dvec3 up = glm::dot(way, normal) * normal;
    if (count != 2 || !(glm::dot(borders[0], borders[1]) < straight)) {
        return up; // Corners of borders stay.
    }
    const glm::dvec3 along = borders[1] - borders[0];
    const glm::dvec3 flat = along - glm::dot(along, normal) * normal;
    const double flat2 = glm::dot(flat, flat);
    return flat2 > 0.0 ? up + glm::dot(way, flat) / flat2 * flat : up;
}

SlotMap WorkingSurface::compact() {
    SlotMap kept = mesh.compact();
    compact_slots(places, kept.vertices);
    if (coloured()) { compact_slots(colours, kept.vertices); }
    if (!materials.empty()) { compact_slots(materials, kept.faces); }
    return kept;
}

TriangleMesh WorkingSurface::to_mesh(const TriangleMesh& original, const WorkingUnits& units) const {
    TriangleMesh made;
    made.name = original.name;
    made.materials = original.materials;
    std::vector<std::uint32_t> numbers(mesh.vertex_slots(), none);
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
        if (!mesh.has_vertex(v)) { continue; }
        numbers[v] = static_cast<std::uint32_t>(made.vertices_m.size());
        made.vertices_m.push_back(to_file(places[v], units));
        if (coloured()) { made.colours.push_back(units.colour_to_file(colours[v])); }
    }
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        if (!mesh.has_face(face)) { continue; }
        const Triangle corners = mesh.corners(face);
        made.triangles.push_back({numbers[corners[0]], numbers[corners[1]], numbers[corners[2]]});
        if (!materials.empty()) { made.triangle_materials.push_back(materials[face]); }
    }
    return made;
}

} // namespace octant::models::simplify
