#pragma once

#include <glm/vec3.hpp>

#include <array>

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

/// The part that H. Hoppe (1999) adds for three colours that are linear functions of position on each triangle: weight
/// * (gradient^T p + offset - colour)^2, summed. Its part without the colour is kept in the Quadric.
struct ColourQuadric {
    std::array<glm::dvec3, 3> gradient{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
    glm::dvec3 offset{0.0};
    double weight = 0.0;

    ColourQuadric& operator+=(const ColourQuadric& other);

    /// The colour of least cost at `p`.
    glm::dvec3 colour_at(const glm::dvec3& p) const;
};

/// Adds the colours of one triangle to both quadrics.
void add_colours(Quadric& quadric, ColourQuadric& colours, const std::array<glm::dvec3, 3>& corners,
    const std::array<glm::dvec3, 3>& corner_colours, double weight);

/// The quadric that is left when at each position the best colours are chosen.
Quadric without_colours(const Quadric& quadric, const ColourQuadric& colours);

/// The position of the least sum, drawn slightly towards `middle`, so that flat and straight surroundings have one
/// answer, too.
glm::dvec3 min_place(const Quadric& quadric, const glm::dvec3& middle);

/// The product of the 3 x 3 matrix and a vector.
glm::dvec3 product(const Quadric& matrix, const glm::dvec3& vector);

/// Solves a symmetric positive definite 3 x 3 system; `fallback` where it has no solution.
glm::dvec3 solved(const Quadric& matrix, const glm::dvec3& right_side, const glm::dvec3& fallback);

} // namespace octant::models::simplify
