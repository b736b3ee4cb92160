// Quadric error metrics of vertices: M. Garland, P. Heckbert, "Surface Simplification Using Quadric Error Metrics",
// 1997, weighted by area, with their constraint planes for boundaries (section 6), here also for creases and borders of
// materials; colours after H. Hoppe, "New Quadric Metric for Simplifying Meshes with Appearance Attributes", 1999,
// section 4.
//
// Deviations: instead of a test whether the matrix can be inverted, the position of least cost is attracted to the
// midpoint of the edge, by the share `pull` of the matrix's trace.

#include "models/simplify/quadrics.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace octant::models::simplify {

namespace {

constexpr double pull = 1e-4; ///< The weight of the midpoint, as a share of the trace.

} // namespace

glm::dvec3 product(const Quadric& q, const glm::dvec3& p) {
    return {q.xx * p.x + q.xy * p.y + q.xz * p.z, q.xy * p.x + q.yy * p.y + q.yz * p.z,
        q.xz * p.x + q.yz * p.y + q.zz * p.z};
}

Quadric& Quadric::operator+=(const Quadric& other) {
    xx += other.xx;
    xy += other.xy;
    xz += other.xz;
    yy += other.yy;
    yz += other.yz;
    zz += other.zz;
    b += other.b;
    c += other.c;
    return *this;
}

void Quadric::add_plane(const glm::dvec3& normal, double offset, double weight) {
    xx += weight * normal.x * normal.x;
    xy += weight * normal.x * normal.y;
    xz += weight * normal.x * normal.z;
    yy += weight * normal.y * normal.y;
    yz += weight * normal.y * normal.z;
    zz += weight * normal.z * normal.z;
    b += (weight * offset) * normal;
    c += weight * offset * offset;
}

double Quadric::at(const glm::dvec3& p) const { return glm::dot(p, product(*this, p) + 2.0 * b) + c; }

ColourQuadric& ColourQuadric::operator+=(const ColourQuadric& other) {
    for (std::size_t i = 0; i < 3; ++i) { gradient[i] += other.gradient[i]; }
    offset += other.offset;
    weight += other.weight;
    return *this;
}

glm::dvec3 ColourQuadric::colour_at(const glm::dvec3& p) const {
    if (weight <= 0.0) { return glm::dvec3(0.0); }
    const glm::dvec3 sum(glm::dot(gradient[0], p), glm::dot(gradient[1], p), glm::dot(gradient[2], p));
    return (sum + offset) / weight;
}

namespace {

/// Adds the colours of one triangle to both quadrics.
void add_colours(Quadric& quadric, ColourQuadric& colours, const std::array<glm::dvec3, 3>& corners,
    const std::array<glm::dvec3, 3>& corner_colours, double weight) {
    const glm::dvec3 ab = corners[1] - corners[0];
    const glm::dvec3 ac = corners[2] - corners[0];
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double size = glm::dot(normal, normal);
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 gradient(0.0);
        if (size > 0.0) {
            const double to_b = corner_colours[1][i] - corner_colours[0][i];
            const double to_c = corner_colours[2][i] - corner_colours[0][i];
            gradient = (to_b * glm::cross(ac, normal) + to_c * glm::cross(normal, ab)) / size;
        }
        const double offset = corner_colours[0][i] - glm::dot(gradient, corners[0]);
        quadric.add_plane(gradient, offset, weight);
        colours.gradient[static_cast<std::size_t>(i)] += weight * gradient;
        colours.offset[i] += weight * offset;
    }
    colours.weight += weight;
}

/// The quadric of positions with the best colour at each position.
Quadric without_colours(const Quadric& quadric, const ColourQuadric& colours) {
    Quadric left = quadric;
    if (colours.weight > 0.0) {
        const double share = 1.0 / colours.weight;
        for (int i = 0; i < 3; ++i) {
            left.add_plane(
                share * colours.gradient[static_cast<std::size_t>(i)], share * colours.offset[i], -colours.weight);
        }
    }
    return left;
}

} // namespace

glm::dvec3 solved(const Quadric& m, const glm::dvec3& right_side, const glm::dvec3& fallback) {
    // Cholesky decomposition into L D L^T.
    if (!(m.xx > 0.0)) { return fallback; }
    const double l10 = m.xy / m.xx;
    const double l20 = m.xz / m.xx;
    const double d1 = m.yy - l10 * m.xy;
    const double e = m.yz - l20 * m.xy;
    if (!(d1 > 0.0)) { return fallback; }
    const double l21 = e / d1;
    const double d2 = m.zz - l20 * m.xz - l21 * e;
    if (!(d2 > 0.0)) { return fallback; }
    const double y1 = right_side.y - l10 * right_side.x;
    const double y2 = right_side.z - l20 * right_side.x - l21 * y1;
    const double z = y2 / d2;
    const double y = y1 / d1 - l21 * z;
    return {right_side.x / m.xx - l10 * y - l20 * z, y, z};
}

namespace {

/// The position of the least sum, attracted slightly to `middle`, which makes it unique on planes and along lines.
glm::dvec3 min_place(const Quadric& quadric, const glm::dvec3& middle) {
    Quadric drawn = quadric;
    const double weight = pull * quadric.trace();
    drawn.xx += weight;
    drawn.yy += weight;
    drawn.zz += weight;
    // Solved for the way from the last place, which keeps its digits; each step after the first takes off what the pull
    // spoiled where the place is certain.
    glm::dvec3 place = middle;
    for (int step = 0; step < 3; ++step) {
        place += solved(drawn, -(product(quadric, place) + quadric.b), glm::dvec3(0.0));
    }
    return place;
}

} // namespace

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
