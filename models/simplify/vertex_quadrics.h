#pragma once

#include "models/simplify/quadric.h"
#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <vector>

namespace octant::models::simplify {

/// Where the vertex that an edge collapses into goes, and what the quadrics say it costs.
struct Placement {
    glm::dvec3 place{0.0};
    glm::dvec3 colour{0.0};
    double cost = 0.0;   ///< weighted sum of squared distances, colours included
    double weight = 0.0; ///< area that the sum runs over
};

/// How much planes upright on edges count, of the edge's length squared.
struct EdgeWeights {
    double boundary = 3.0; ///< and border of materials
    double crease = 0.3;
    double crease_cosine = 0.7; ///< of the angle between normals from which on an edge is sharp
};

/// Quadrics of the vertices of a surface: planes of triangles by area, planes upright on
/// boundaries, on borders of materials and on sharp edges, colours where there are any.
class VertexQuadrics {
public:
    VertexQuadrics(const WorkingSurface& surface, const EdgeWeights& weights);

    Placement placement(const WorkingSurface& surface, HalfEdge h) const;

    /// Gives the sum of both to `kept`.
    void merge(std::uint32_t kept, std::uint32_t gone);

private:
    void add_face(const WorkingSurface& surface, std::uint32_t face);
    void add_edge(const WorkingSurface& surface, HalfEdge h, const EdgeWeights& weights);

    std::vector<Quadric> quadrics_;
    std::vector<ColourQuadric> colours_; ///< empty = none
};

} // namespace octant::models::simplify
