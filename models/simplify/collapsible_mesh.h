#pragma once

#include "models/collapse_sequence.h"
#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// Half-edge h of triangle h / 3 runs from corner h % 3 to the next one.
using HalfEdge = std::uint32_t;

constexpr HalfEdge next_of(HalfEdge h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}

constexpr HalfEdge previous_of(HalfEdge h) {
    return h % 3 == 0 ? h + 2 : h - 1;
}

constexpr std::uint32_t face_of(HalfEdge h) {
    return h / 3;
}

/// A triangle of the neighbourhood of an edge that is about to collapse: `half_edge` starts at the
/// end of the edge that moves.
struct RingFace {
    std::uint32_t face = none;
    HalfEdge half_edge = none;
};

/// Triangles and which ones share edges: an oriented manifold, perhaps with boundary, that stays
/// one. Nothing is allocated by a collapse; triangles keep their numbers.
class CollapsibleMesh {
public:
    /// Asserts that every edge lies in at most two triangles, of opposite directions.
    CollapsibleMesh(std::size_t vertices, std::span<const Triangle> triangles);

    std::uint32_t origin(HalfEdge h) const { return origins_[h]; }

    std::uint32_t target(HalfEdge h) const { return origins_[next_of(h)]; }

    /// The same edge in the other triangle; none on a boundary.
    HalfEdge twin(HalfEdge h) const { return twins_[h]; }

    /// Of an edge's one or two half-edges the smaller: its number.
    HalfEdge edge_of(HalfEdge h) const { return h < twins_[h] ? h : twins_[h]; }

    bool face_is_there(std::uint32_t face) const { return origins_[face * 3] != none; }

    bool vertex_is_there(std::uint32_t vertex) const { return outs_[vertex] != none; }

    std::size_t face_slots() const { return origins_.size() / 3; }

    std::size_t vertex_slots() const { return outs_.size(); }

    std::size_t face_count() const { return face_count_; }

    std::size_t vertex_count() const { return vertex_count_; }

    bool is_boundary_vertex(std::uint32_t vertex) const { return twins_[outs_[vertex]] == none; }

    /// Some triangle at the vertex, which must be there.
    std::uint32_t face_at(std::uint32_t vertex) const { return face_of(outs_[vertex]); }

    Triangle corners(std::uint32_t face) const {
        return {origins_[face * 3], origins_[face * 3 + 1], origins_[face * 3 + 2]};
    }

    /// Calls `visit(half_edge)` for each half-edge that starts at `vertex`, one a triangle,
    /// counter-clockwise.
    template <typename Visit>
    void around(std::uint32_t vertex, const Visit& visit) const {
        const HalfEdge first = outs_[vertex];
        HalfEdge h = first;
        do {
            visit(h);
            h = twins_[previous_of(h)];
        } while (h != none && h != first);
    }

    /// Calls `visit(half_edge)` once for each edge at `vertex`; the half-edge may run either way.
    template <typename Visit>
    void edges_around(std::uint32_t vertex, const Visit& visit) const {
        const HalfEdge first = outs_[vertex];
        HalfEdge h = first;
        while (true) {
            visit(h);
            const HalfEdge last = previous_of(h);
            h = twins_[last];
            if (h == none) {
                visit(last);
            }
            if (h == none || h == first) {
                return;
            }
        }
    }

    /// Whether the collapse of an edge leaves a manifold of the same kind (link condition, with the
    /// boundary as one more vertex).
    bool may_collapse(HalfEdge h) const;

    /// Triangles that stay when `h` collapses and have a corner moved.
    void ring_of(HalfEdge h, std::vector<RingFace>& ring) const;

    /// The triangles at a vertex, their half-edges starting there, and their numbers.
    void ring_at(
        std::uint32_t vertex, std::vector<RingFace>& ring, std::vector<std::uint32_t>& faces) const;

    /// Moves what was at target(h) to origin(h) and takes the edge's triangles out. Expects
    /// may_collapse(h).
    void collapse(HalfEdge h);

    /// Whether the other diagonal of the two triangles at `h` may replace it.
    bool may_flip(HalfEdge h) const;

    /// Turns the edge: `h` then runs from corner to corner of the other diagonal, and both
    /// triangles keep their numbers.
    void flip(HalfEdge h);

private:
    void join(HalfEdge a, HalfEdge b);
    void set_out(HalfEdge h);
    void take_out(HalfEdge h);
    bool has_one_fan_a_vertex() const;
    bool is_neighbour(std::uint32_t vertex, std::uint32_t other) const;

    std::vector<std::uint32_t> origins_; ///< none: the triangle is gone
    std::vector<HalfEdge> twins_;
    std::vector<HalfEdge> outs_; ///< one that starts at the vertex: on a boundary the first
    std::size_t face_count_ = 0;
    std::size_t vertex_count_ = 0;
    mutable std::vector<std::uint32_t> marks_; ///< a vertex seen in search `mark_`
    mutable std::uint32_t mark_ = 0;
};

} // namespace octant::models::simplify
