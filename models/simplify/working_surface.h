#pragma once

#include "models/collapse_sequence.h"
#include "models/measure/triangle_bvh.h"
#include "models/simplify/collapsible_mesh.h"
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
