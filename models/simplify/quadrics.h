#pragma once

#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// A quadric error metric in space: the weighted sum of squared distances to planes, p^T A p + 2 b^T p + c.
struct Quadric {
    double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0; ///< The symmetric matrix A.
    glm::dvec3 b{0.0};
    double c = 0.0;

    Quadric& operator+=(const Quadric& other);

    /// Adds weight * (normal.p + offset)^2.
    void add_plane(const glm::dvec3& normal, double offset, double weight);

    double at(const glm::dvec3& p) const;

    double trace() const { return xx + yy + zz; }
};

/// The part that H. Hoppe (1999) adds for three colour components that are linear on each triangle: the sum of weight *
/// (gradient^T p + offset - colour)^2. The terms without the colour are in the Quadric.
struct ColourQuadric {
    std::array<glm::dvec3, 3> gradient{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
    glm::dvec3 offset{0.0};
    double weight = 0.0;

    ColourQuadric& operator+=(const ColourQuadric& other);

    /// The colour with the least cost at `p`.
    glm::dvec3 colour_at(const glm::dvec3& p) const;
};

/// The product of the 3 x 3 matrix and a vector.
glm::dvec3 product(const Quadric& matrix, const glm::dvec3& vector);

/// Solves a symmetric positive definite 3 x 3 system; returns `fallback` if there is no solution.
glm::dvec3 solved(const Quadric& matrix, const glm::dvec3& right_side, const glm::dvec3& fallback);

/// The vertex into which an edge collapses, and its cost by the quadrics.
struct VertexPlacement {
    glm::dvec3 place{0.0};
    glm::dvec3 colour{0.0};
    double cost = 0.0; ///< The weighted sum of squared distances, colours included.
    /// The trace of the summed quadrics: a third of the area of each triangle, and the weights of constraint planes and
    /// of colour gradients. cost / weight is a mean squared distance.
    double weight = 0.0;
};

/// The weights of constraint planes, which are perpendicular to the surface along special edges, in squares of the
/// edge's length.
struct EdgeWeights {
    double boundary = 3.0; ///< For boundaries and for borders between materials.
    /// For sharp edges (creases).
    double crease = 0.3;
    /// An edge is sharp when the cosine between its normals is below this.
    double crease_cosine = 0.7;
};

/// The edge weights when quadrics are also the costs: smaller than the default ones, which only guide the position.
inline constexpr EdgeWeights cost_weights{.boundary = 1.0, .crease = 0.1, .crease_cosine = 0.5};

/// The quadrics of all vertices of a surface: planes of triangles, weighted by area; constraint planes along
/// boundaries, borders of materials and creases; and colours of coloured meshes.
class VertexQuadrics {
public:
    VertexQuadrics(const WorkingSurface& surface, const EdgeWeights& weights);

    /// The vertex that the collapse of an edge would make.
    VertexPlacement placement(const WorkingSurface& surface, HalfEdge h) const;

    /// Adds the quadric of `gone` to that of `kept`.
    void merge(std::uint32_t kept, std::uint32_t gone);

    void copy(std::uint32_t from, std::uint32_t to);

    /// Keeps the entries of these slots, in the new numbering of CollapsibleMesh::compact.
    void keep(std::span<const std::uint32_t> vertices);

private:
    void add_face(const WorkingSurface& surface, std::uint32_t face);
    void add_edge(const WorkingSurface& surface, HalfEdge h, const EdgeWeights& weights);

    std::vector<Quadric> quadrics_;
    std::vector<ColourQuadric> colours_; ///< Empty = no colours.
};

} // namespace octant::models::simplify
