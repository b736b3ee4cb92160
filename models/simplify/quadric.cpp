// Quadric error metrics: M. Garland, P. Heckbert, "Surface Simplification Using Quadric Error Metrics", 1997, weighted
// by area; colours after H. Hoppe, "New Quadric Metric for Simplifying Meshes with Appearance Attributes", 1999,
// section 4.
//
// Deviations: instead of testing whether the matrix can be inverted, the position of least cost is drawn towards the
// midpoint of the edge, by the share `pull` of the matrix's trace.
#include "models/simplify/quadric.h"

#include <glm/geometric.hpp>

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

} // namespace octant::models::simplify
