#pragma once

#include <glm/vec3.hpp>

#include <array>

namespace octant::models::simplify {

/// Weighted sum of squared distances to planes: p.A p + 2 b.p + c.
struct Quadric {
    double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0; ///< A
    glm::dvec3 b{0.0};
    double c = 0.0;

    Quadric& operator+=(const Quadric& other);

    /// Adds weight * (normal.p + offset)^2.
    void add_plane(const glm::dvec3& normal, double offset, double weight);

    double at(const glm::dvec3& p) const;

    double trace() const { return xx + yy + zz; }
};

/// What Hoppe 1999 adds for three colours that are linear functions of position on each triangle:
/// weight * (gradient.p + offset - colour)^2, whose part without the colour is in the Quadric.
struct ColourQuadric {
    std::array<glm::dvec3, 3> gradient{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
    glm::dvec3 offset{0.0};
    double weight = 0.0;

    ColourQuadric& operator+=(const ColourQuadric& other);

    /// The colour of least cost at `p`.
    glm::dvec3 colour_at(const glm::dvec3& p) const;
};

/// Adds one triangle's colours to both.
void add_colours(
    Quadric& quadric,
    ColourQuadric& colours,
    const std::array<glm::dvec3, 3>& corners,
    const std::array<glm::dvec3, 3>& corner_colours,
    double weight);

/// What is left of the sum at the best colours for each place.
Quadric without_colours(const Quadric& quadric, const ColourQuadric& colours);

/// Where the sum is least, drawn to `middle` a little, so that flat and straight places have one
/// answer.
glm::dvec3 least_place(const Quadric& quadric, const glm::dvec3& middle);

/// Solves a symmetric positive definite 3 x 3 system; `fallback` where it has no solution.
glm::dvec3 solved(const Quadric& matrix, const glm::dvec3& right_side, const glm::dvec3& fallback);

} // namespace octant::models::simplify
