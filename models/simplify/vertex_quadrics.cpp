// Builds the quadrics of vertices: M. Garland, P. Heckbert, "Surface Simplification Using Quadric Error Metrics", 1997,
// with their constraint planes for boundaries (section 6), which here also hold creases and borders of materials.
#include "models/simplify/vertex_quadrics.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::models::simplify {

VertexQuadrics::VertexQuadrics(const WorkingSurface& surface, const EdgeWeights& weights)
    : quadrics_(surface.places.size()), colours_(surface.coloured() ? surface.places.size() : 0) {
    for (std::uint32_t face = 0; face < surface.mesh.face_slots(); ++face) { add_face(surface, face); }
    for (HalfEdge h = 0; h < surface.mesh.face_slots() * 3; ++h) { add_edge(surface, h, weights); }
}

void VertexQuadrics::add_face(const WorkingSurface& surface, std::uint32_t face) {
    const std::array<glm::dvec3, 3> corners = surface.corner_places(face);
    const Triangle vertices = surface.mesh.corners(face);
    const glm::dvec3 area2 = area_vector(corners);
    const double length = glm::length(area2);
    if (!(length > 0.0)) { return; }
    const glm::dvec3 normal = area2 / length;
    // A third of the triangle's area goes to each corner.
    const double weight = length / 6.0;
    Quadric quadric;
    quadric.add_plane(normal, -glm::dot(normal, corners[0]), weight);
    ColourQuadric colours;
    if (surface.coloured()) {
        add_colours(quadric, colours, corners,
            {surface.colours[vertices[0]], surface.colours[vertices[1]], surface.colours[vertices[2]]}, weight);
    }
    for (const std::uint32_t vertex : vertices) {
        quadrics_[vertex] += quadric;
        if (surface.coloured()) { colours_[vertex] += colours; }
    }
}

/// Adds the constraint plane of an edge: through the edge, perpendicular to the triangle of `h`.
void VertexQuadrics::add_edge(const WorkingSurface& surface, HalfEdge h, const EdgeWeights& weights) {
    const CollapsibleMesh& mesh = surface.mesh;
    const glm::dvec3 normal = area_vector(surface.corner_places(face_of(h)));
    double weight = weights.boundary;
    if (mesh.twin(h) != none && !surface.is_material_border(h)) {
        const glm::dvec3 other = area_vector(surface.corner_places(face_of(mesh.twin(h))));
        const double lengths = glm::length(normal) * glm::length(other);
        if (!(glm::dot(normal, other) < weights.crease_cosine * lengths)) { return; }
        weight = weights.crease;
    }
    const glm::dvec3& start = surface.places[mesh.origin(h)];
    const glm::dvec3 edge = surface.places[mesh.target(h)] - start;
    const glm::dvec3 upright = glm::cross(edge, normal);
    const double length = glm::length(upright);
    if (!(length > 0.0)) { return; }
    Quadric quadric;
    const double length2 = glm::dot(edge, edge);
    quadric.add_plane(upright / length, -glm::dot(upright, start) / length, weight * length2);
    quadrics_[mesh.origin(h)] += quadric;
    quadrics_[mesh.target(h)] += quadric;
}

VertexPlacement VertexQuadrics::placement(const WorkingSurface& surface, HalfEdge h) const {
    const std::uint32_t u = surface.mesh.origin(h);
    const std::uint32_t w = surface.mesh.target(h);
    Quadric quadric = quadrics_[u];
    quadric += quadrics_[w];
    const glm::dvec3 middle = 0.5 * (surface.places[u] + surface.places[w]);
    VertexPlacement found;
    found.weight = quadric.trace();
    const std::uint32_t locked = surface.is_locked(u) ? u : surface.is_locked(w) ? w : none;
    if (colours_.empty()) {
        found.place = locked == none ? min_place(quadric, middle) : surface.places[locked];
        found.cost = std::max(quadric.at(found.place), 0.0);
        return found;
    }
    ColourQuadric colours = colours_[u];
    colours += colours_[w];
    const Quadric left = without_colours(quadric, colours);
    found.place = locked == none ? min_place(left, middle) : surface.places[locked];
    found.colour = colours.colour_at(found.place);
    found.cost = std::max(left.at(found.place), 0.0);
    return found;
}

void VertexQuadrics::merge(std::uint32_t kept, std::uint32_t gone) {
    quadrics_[kept] += quadrics_[gone];
    if (!colours_.empty()) { colours_[kept] += colours_[gone]; }
}

void VertexQuadrics::copy(std::uint32_t from, std::uint32_t to) {
    quadrics_[to] = quadrics_[from];
    if (!colours_.empty()) { colours_[to] = colours_[from]; }
}

void VertexQuadrics::keep(std::span<const std::uint32_t> vertices) {
    compact_slots(quadrics_, vertices);
    if (!colours_.empty()) { compact_slots(colours_, vertices); }
}

} // namespace octant::models::simplify
