#pragma once

#include "models/collapse_sequence.h"
#include "models/triangle_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// A half-edge, numbered 3 * triangle + corner: half-edge h of triangle h / 3 runs from corner h % 3 to the next
/// corner, counter-clockwise.
using HalfEdge = std::uint32_t;

constexpr HalfEdge next_of(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }

constexpr HalfEdge previous_of(HalfEdge h) { return h % 3 == 0 ? h + 2 : h - 1; }

constexpr std::uint32_t face_of(HalfEdge h) { return h / 3; }

/// A triangle of the ring around a vertex or an edge to be collapsed. Its `half_edge` starts at the moving corner.
struct RingFace {
    std::uint32_t face = none;
    HalfEdge half_edge = none;
};

/// The slots that remain when a mesh is compacted: their previous numbers, in order.
struct SlotMap {
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint32_t> faces;
};

/// Keeps the entries of the kept slots in a list with one entry a slot, and frees the other memory.
template <typename T>
void compact_slots(std::vector<T>& list, std::span<const std::uint32_t> kept) {
    for (std::size_t i = 0; i < kept.size(); ++i) { list[i] = list[kept[i]]; }
    list.resize(kept.size());
    list.shrink_to_fit();
}

/// The changes of the topology that a collapse may make.
enum class TopologyChanges : std::uint8_t { None, Holes, HolesAndHandles };

/// What the collapse of an edge (u, w) does to the topology.
struct CollapseEffect {
    enum class Kind : std::uint8_t { NotAllowed, SameTopology, ClosesHole, CutsHandle };
    Kind kind = Kind::NotAllowed;
    /// Of a hole or a handle: the half-edges from w to a vertex c and from c to u. With the edge they go around the
    /// hole, which has three edges, or around the handle.
    HalfEdge second = none;
    HalfEdge third = none;
    /// After a cut: the vertex that replaces c to the right of u, w, c. There w replaces u and w.
    std::uint32_t made = none;
};

/// The connectivity of a triangle mesh as half-edges: an oriented manifold, perhaps with boundary, which stays one.
/// Triangles keep their numbers ("slots"); a collapse empties two of them and allocates nothing.
class CollapsibleMesh {
public:
    /// Asserts that every edge lies in at most two triangles that run along it in opposite directions, and that the
    /// triangles of each vertex form a single fan.
    CollapsibleMesh(std::size_t vertices, std::span<const Triangle> triangles);

    std::uint32_t origin(HalfEdge h) const { return origins_[h]; }

    std::uint32_t target(HalfEdge h) const { return origins_[next_of(h)]; }

    /// The half-edge of the same edge in the other triangle; none on a boundary.
    HalfEdge twin(HalfEdge h) const { return twins_[h]; }

    /// The number of an edge: the smaller number of its one or two half-edges.
    HalfEdge edge_of(HalfEdge h) const { return h < twins_[h] ? h : twins_[h]; }

    bool has_face(std::uint32_t face) const { return origins_[face * 3] != none; }

    bool has_vertex(std::uint32_t vertex) const { return outgoing_[vertex] != none; }

    std::size_t face_slots() const { return origins_.size() / 3; }

    std::size_t vertex_slots() const { return outgoing_.size(); }

    std::size_t face_count() const { return face_count_; }

    std::size_t vertex_count() const { return vertex_count_; }

    bool is_boundary_vertex(std::uint32_t vertex) const { return twins_[outgoing_[vertex]] == none; }

    /// A triangle at a vertex, which must exist.
    std::uint32_t face_at(std::uint32_t vertex) const { return face_of(outgoing_[vertex]); }

    Triangle corners(std::uint32_t face) const {
        return {origins_[face * 3], origins_[face * 3 + 1], origins_[face * 3 + 2]};
    }

    /// Calls `visit(half_edge)` for each half-edge that starts at `vertex`, one for each triangle, counter-clockwise.
    template <typename Visit>
    void around(std::uint32_t vertex, const Visit& visit) const {
        const HalfEdge first = outgoing_[vertex];
        HalfEdge h = first;
        do {
            visit(h);
            h = twins_[previous_of(h)];
        } while (h != none && h != first);
    }

    /// Calls `visit(half_edge)` once for each edge at `vertex`. On a boundary the half-edge of the last edge ends at
    /// the vertex; all others start there.
    template <typename Visit>
    void edges_around(std::uint32_t vertex, const Visit& visit) const {
        const HalfEdge first = outgoing_[vertex];
        HalfEdge h = first;
        while (true) {
            visit(h);
            const HalfEdge last = previous_of(h);
            h = twins_[last];
            if (h == none) { visit(last); }
            if (h == none || h == first) { return; }
        }
    }

    /// What collapsing an edge does: the same topology is left where the link condition holds, where the boundary
    /// counts as one more vertex. Where a third common neighbour of the ends breaks it, the collapse closes a hole of
    /// three edges or cuts a handle, if that is allowed; a cut needs a vertex slot that a collapse has emptied before.
    CollapseEffect effect_of(HalfEdge h, TopologyChanges allowed) const;

    /// Fills `ring` with the triangles that stay when `h` collapses and have a corner that moves.
    void ring_of(HalfEdge h, std::vector<RingFace>& ring) const;

    /// Fills `ring` and `faces` with the triangles at a vertex.
    void ring_at(std::uint32_t vertex, std::vector<RingFace>& ring, std::vector<std::uint32_t>& faces) const;

    /// Collapses an edge: all that met target(h) then meets origin(h), and the edge's triangles go. effect_of(h) must
    /// allow it. Where a handle is cut, its two sides get vertices of their own, which lie at the same places. Returns
    /// what it did.
    CollapseEffect collapse(HalfEdge h);

    /// Splits an edge, which must have two triangles, at a new vertex, whose slot must be free, as must be the slots of
    /// `faces`. `h` then runs from its origin to the new vertex; the first of the new triangles takes the rest of its
    /// triangle, the second that of the twin's.
    void split(HalfEdge h, std::uint32_t vertex, const std::array<std::uint32_t, 2>& faces);

    /// Removes a triangle. The caller must remove all triangles of its shell before any other use of the shell.
    void remove(std::uint32_t face);

    /// Frees the slots of removed vertices and triangles and renumbers the others.
    SlotMap compact();

    /// Whether the edge may be replaced by the other diagonal of its two triangles.
    bool may_flip(HalfEdge h) const;

    /// Flips an edge: `h` then runs along the other diagonal. Both triangles keep their numbers.
    void flip(HalfEdge h);

private:
    void join(HalfEdge a, HalfEdge b);
    void set_outgoing(HalfEdge h);
    void take_out(HalfEdge h);
    bool is_vertex_manifold() const;
    bool is_neighbour(std::uint32_t vertex, std::uint32_t other) const;
    CollapseEffect effect_on_cycle(HalfEdge h, std::uint32_t c) const;
    bool is_connected_without(const std::array<HalfEdge, 3>& cycle) const;
    void set_fan_vertex(HalfEdge h, std::uint32_t vertex);

    /// For each half-edge the vertex that it starts from; none = the triangle is gone.
    std::vector<std::uint32_t> origins_;
    std::vector<HalfEdge> twins_;
    /// For each vertex a half-edge that starts there; at a boundary vertex the one from which around() reaches all
    /// triangles.
    std::vector<HalfEdge> outgoing_;
    std::size_t face_count_ = 0;
    std::size_t vertex_count_ = 0;
    /// For each vertex the number of the last search that met it.
    mutable std::vector<std::uint32_t> marks_;
    mutable std::uint32_t mark_ = 0;
    /// For each triangle the number of the last search that met it; made when first needed.
    mutable std::vector<std::uint32_t> face_marks_;
    mutable std::uint32_t face_mark_ = 0;
    std::uint32_t free_vertex_slot_ = none; ///< The last slot that a collapse emptied.
};

} // namespace octant::models::simplify
