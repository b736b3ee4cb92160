#pragma once

#include "models/simplify/quadric.h"
#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// Where the vertex that an edge collapses into is placed, and its cost by the quadrics.
struct VertexPlacement {
    glm::dvec3 place{0.0};
    glm::dvec3 colour{0.0};
    double cost = 0.0;   ///< The weighted sum of squared distances, colours included.
    double weight = 0.0; ///< The area that the sum runs over.
};

/// The weights of constraint planes, which stand perpendicular on the surface along special edges, in squares of the
/// edge's length.
struct EdgeWeights {
    double boundary = 3.0; ///< For boundaries and for borders between materials.
    /// For sharp edges (creases).
    double crease = 0.3;
    /// An edge is sharp when the cosine between its normals is below this.
    double crease_cosine = 0.7;
};

/// The edge weights where quadrics are the costs, too: lighter, as the default ones only guide the place while
/// distances decide the cost.
inline constexpr EdgeWeights cost_weights{.boundary = 1.0, .crease = 0.1, .crease_cosine = 0.5};

/// The quadrics of all vertices of a surface: planes of triangles, weighted by area; constraint planes along
/// boundaries, borders of materials and creases; and colours where there are any.
class VertexQuadrics {
public:
    VertexQuadrics(const WorkingSurface& surface, const EdgeWeights& weights);

    /// Where the collapse of an edge would place its vertex.
    VertexPlacement placement(const WorkingSurface& surface, HalfEdge h) const;

    /// Gives the sum of both vertices' quadrics to `kept`.
    void merge(std::uint32_t kept, std::uint32_t gone);

    void copy(std::uint32_t from, std::uint32_t to);

    /// Leaves those of the kept slots, as CollapsibleMesh::compact numbers them.
    void keep(std::span<const std::uint32_t> vertices);

private:
    void add_face(const WorkingSurface& surface, std::uint32_t face);
    void add_edge(const WorkingSurface& surface, HalfEdge h, const EdgeWeights& weights);

    std::vector<Quadric> quadrics_;
    std::vector<ColourQuadric> colours_; ///< Empty = no colours.
};

} // namespace octant::models::simplify
