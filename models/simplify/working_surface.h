#pragma once

#include "models/collapse_sequence.h"
#include "models/measure/triangle_bvh.h"
#include "models/triangle_mesh.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
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

    /// Whether collapsing an edge leaves a manifold of the same topology.
    bool may_collapse(HalfEdge h) const {
        return effect_of(h, TopologyChanges::None).kind == CollapseEffect::Kind::SameTopology;
    }

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

/// The units in which the simplifier works: the centre of the mesh's bounding box is the origin and the box's diagonal
/// is 1. A colour is multiplied by `colour_scale`, so that distances in the space of (position, colour) count both.
struct WorkingUnits {
    glm::dvec3 middle_m{0.0};
    double diagonal_m = 1.0;
    double colour_scale = 1.0;

    static WorkingUnits of(const TriangleMesh& mesh, double colour_weight);

    glm::dvec3 from_file(const glm::dvec3& place_m) const { return (place_m - middle_m) / diagonal_m; }

    glm::dvec3 to_file(const glm::dvec3& place) const { return middle_m + place * diagonal_m; }

    /// Of all vertices of a mesh.
    std::vector<glm::dvec3> places_of(const TriangleMesh& mesh) const;

    /// Of all vertices of a mesh; empty where it has no colours.
    std::vector<glm::dvec3> colours_of(const TriangleMesh& mesh) const;

    glm::vec3 colour_to_file(const glm::dvec3& colour) const;
};

/// A mesh that is being changed, in working units.
struct WorkingSurface {
    WorkingSurface(const TriangleMesh& mesh, const WorkingUnits& units);

    CollapsibleMesh mesh;
    std::vector<glm::dvec3> places;       ///< One for each vertex slot.
    std::vector<glm::dvec3> colours;      ///< One for each vertex slot; empty = no colours.
    std::vector<std::uint32_t> materials; ///< One for each triangle slot; empty = no materials.

    /// Locks boundary vertices at their positions in `from`, the mesh of which this was made.
    void lock_border(const TriangleMesh& from, const WorkingUnits& units);

    bool locks_border() const { return !locked_m.empty(); }

    bool is_locked(std::uint32_t vertex) const { return locks_border() && mesh.is_boundary_vertex(vertex); }

    /// What the collapse of an edge does: CollapsibleMesh::effect_of, but an edge of a locked border may not collapse.
    CollapseEffect effect_of(HalfEdge h, TopologyChanges allowed) const {
        return locks_border() && mesh.twin(h) == none ? CollapseEffect{} : mesh.effect_of(h, allowed);
    }

    /// Whether an edge may collapse without a change of the topology.
    bool may_collapse(HalfEdge h) const {
        return effect_of(h, TopologyChanges::None).kind == CollapseEffect::Kind::SameTopology;
    }

    /// Converts a position to file units; that of a locked vertex becomes the file's to the bit.
    glm::dvec3 to_file(const glm::dvec3& place, const WorkingUnits& units) const;

    /// Positions of locked vertices in the file, by their positions in working units.
    std::map<std::array<double, 3>, glm::dvec3> locked_m;

    bool coloured() const { return !colours.empty(); }

    /// Black where there are no colours.
    glm::dvec3 colour_of(std::uint32_t vertex) const { return coloured() ? colours[vertex] : glm::dvec3(0.0); }

    void set_vertex(std::uint32_t vertex, const glm::dvec3& place, const glm::dvec3& colour) {
        places[vertex] = place;
        if (coloured()) { colours[vertex] = colour; }
    }

    std::array<glm::dvec3, 3> corner_places(std::uint32_t face) const {
        const Triangle corners = mesh.corners(face);
        return {places[corners[0]], places[corners[1]], places[corners[2]]};
    }

    /// Whether the two triangles of an edge have different materials.
    bool is_material_border(HalfEdge h) const {
        return !materials.empty() && mesh.twin(h) != none && materials[face_of(h)] != materials[face_of(mesh.twin(h))];
    }

    /// Whether the surface or a material ends at an edge.
    bool is_border(HalfEdge h) const { return mesh.twin(h) == none || is_material_border(h); }

    /// Whether an edge at a vertex is a border.
    bool is_border_vertex(std::uint32_t vertex) const;

    /// The part of a vertex's displacement that does not move a border through it: perpendicular to the surface and
    /// along the border. The whole displacement without a border; zero for a locked vertex.
    glm::dvec3 along_borders(std::uint32_t vertex, const glm::dvec3& way) const;

    /// Frees the slots of removed vertices and triangles.
    SlotMap compact();

    /// The present mesh in file units, vertices and triangles in the order of their slots. Name and materials are those
    /// of `original`.
    TriangleMesh to_mesh(const TriangleMesh& original, const WorkingUnits& units) const;
};

/// The normal of a triangle with twice its area as its length.
inline glm::dvec3 area_vector(const std::array<glm::dvec3, 3>& corners) {
    return glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

/// Whether a triangle with corners `before` may get the corners `after`: it turns by less than 90 degrees and has an
/// area. One without an area may become any that has one.
bool is_valid_deformation(const std::array<glm::dvec3, 3>& before, const std::array<glm::dvec3, 3>& after);

/// Whether the two triangles at an edge may become the two given ones when the edge is flipped, whichever new one is
/// compared with whichever old one.
bool may_flip_to(
    const std::array<std::array<glm::dvec3, 3>, 2>& before, const std::array<std::array<glm::dvec3, 3>, 2>& after);

/// Whether every triangle of a ring may have its moving corner at `place`, by is_valid_deformation.
bool may_move(const WorkingSurface& surface, std::span<const RingFace> ring, const glm::dvec3& place);

/// The corners of a triangle of a ring when its moving corner is at `place`; that corner comes first.
inline std::array<glm::dvec3, 3> moved_corners(
    const WorkingSurface& surface, const RingFace& face, const glm::dvec3& place) {
    return {place, surface.places[surface.mesh.target(face.half_edge)],
        surface.places[surface.mesh.origin(previous_of(face.half_edge))]};
}

/// A point of the original surface.
struct OriginalPoint {
    std::array<float, 3> place{};
    std::uint32_t triangle = none; ///< That it lies on.
};

/// The surface that is approximated, in working units, for nearest points near a known one.
class OriginalSurface {
public:
    /// `surface` is what `mesh`, which must outlive this, was made into, before any change.
    OriginalSurface(const WorkingSurface& surface, const TriangleMesh& mesh, const WorkingUnits& units);

    /// A point of the surface that is nearer than all around it, found by going from triangle to triangle, from `start`
    /// on, as long as that leads nearer. So the side of a thin part stays the same. The squared distance goes to
    /// `distance2`.
    OriginalPoint nearest_from(std::uint32_t start, const glm::dvec3& point, double& distance2) const;

    /// Tells the processor that a triangle will be asked for.
    void prefetch(std::uint32_t triangle) const {
        __builtin_prefetch(&mesh_.triangles[triangle]);
        __builtin_prefetch(&neighbours_[triangle]);
    }

    /// The normal of a triangle, of any length.
    glm::dvec3 normal(std::uint32_t triangle) const;

    /// The squared distance to a triangle.
    double distance2(std::uint32_t triangle, const glm::dvec3& point) const {
        return nearest_on(triangle, point).distance2;
    }

    /// The number of triangles.
    std::size_t size() const { return neighbours_.size(); }

    /// A tree over the triangles in the mesh's own units, for whoever measures distances to it. It is built when it is
    /// first needed.
    const std::shared_ptr<const measure::TriangleBvh>& tree() const;

    /// The nearest point of the whole surface.
    measure::NearestOnMesh nearest(const glm::dvec3& place) const;

    /// Calls `take(triangle)` for all triangles that are at most `within` away, and for some that are a little farther.
    template <typename Take>
    void for_each_near(const glm::dvec3& place, double within, const Take& take) const {
        tree()->for_each_near(units_.to_file(place), within * units_.diagonal_m, take);
    }

    /// The triangle beyond each side of a triangle, or none.
    const std::array<std::uint32_t, 3>& beyond(std::uint32_t triangle) const { return neighbours_[triangle]; }

private:
    /// The nearest point of a triangle, and which of its sides or corners it lies on.
    struct OnTriangle {
        glm::dvec3 place{0.0};
        double distance2 = 0.0;
        std::uint32_t side = none;   ///< From this corner to the next one; none = inside.
        std::uint32_t corner = none; ///< This one; `side` is none then.
    };

    OnTriangle nearest_on(std::uint32_t triangle, const glm::dvec3& point) const;

    const TriangleMesh& mesh_;
    WorkingUnits units_;
    std::vector<glm::dvec3> places_;
    mutable std::shared_ptr<const measure::TriangleBvh> tree_; ///< Null = not built so far.
    std::vector<std::array<std::uint32_t, 3>> neighbours_;     ///< The triangle beyond each side, or none.
};

} // namespace octant::models::simplify
