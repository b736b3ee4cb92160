#pragma once

#include "models/simplify/simplify_options.h"
#include "models/triangle_mesh.h"

#include <array>
#include <cstddef>

namespace octant::models::simplify {

/// A position and a weighted colour as one point: x, y, z (metres), w r, w g, w b; the last three 0 where colour does
/// not count.
using Point6 = std::array<double, 6>;

using Corners = std::array<Point6, 3>;

/// Where the perpendicular from a point meets a triangle's plane, and the distance to the triangle.
struct Foot {
    /// The foot a P1 + b P2 + c P3 has 0 < a, b, c < 1. A foot on the border counts as outside.
    bool inside = false;
    /// The squared distance to the triangle: to the foot where that is inside, else to the border.
    double distance2 = 0.0;
};

/// Drops the perpendicular from `x`. A triangle without area has no inside.
Foot foot_on(const Corners& triangle, const Point6& x);

/// A quadric error metric in six dimensions: the sum of squared distances to planes, x^T A x + 2 b^T x + c with a
/// symmetric A. The default one has no plane and is 0 everywhere.
class PlaneQuadric {
public:
    /// The quadric of the plane in space through a triangle's corners, whatever their colours; that of no plane for a
    /// triangle without area.
    static PlaneQuadric of_plane(const Corners& triangle);

    /// The quadric of the plane that a triangle spans in six dimensions, colours included.
    static PlaneQuadric of_coloured_plane(const Corners& triangle);

    void add(const PlaneQuadric& other);

    /// The value at a point, at least 0 (rounding below is cut off).
    double at(const Point6& x) const;

private:
    std::array<double, 21> a_{}; ///< The upper triangle of A, row after row.
    Point6 b_{};
    double c_ = 0.0;
};

/// The error measures that the 2005 paper compares.
enum class PaperMeasure {
    Plane,        ///< The previous measure: squared distances to planes, as quadrics.
    Triangle,     ///< Proposed: squared distances to triangles, in one direction.
    Bidirectional ///< Proposed: the larger one of both directions.
};

/// How to simplify as printed in the paper.
struct PaperOptions {
    PaperMeasure measure = PaperMeasure::Bidirectional;
    /// Vertices or faces; error_m must be empty (asserted). As in the paper, unreferenced vertices count.
    Goal goal;
    std::size_t uncounted = 0; ///< number of unreferenced vertices of the file that the mesh does not have
    /// w of distances in the six dimensions (position, w rgb), in metres; 0 = position only.
    double colour_weight = 0.0;
    /// The shortest edge is searched for in six dimensions, too.
    bool colour_in_edge_length = false;
    ShowProgress show_progress;
};

/// The costs of the chosen contractions, each against the mesh before it, summed over all of them: the paper's error,
/// in square metres.
struct PaperSums {
    double plane_m2 = 0.0;         ///< Quadrics at the new vertices.
    double triangle_m2 = 0.0;      ///< From the new vertices to the triangles that they replace.
    double bidirectional_m2 = 0.0; ///< The larger one of that and the opposite direction.
};

/// The simplified mesh and the figures of the paper's tables.
struct PaperResult {
    TriangleMesh mesh;
    std::size_t contractions = 0;
    std::size_t counted_vertices = 0; ///< How many vertices are left, as the paper counts them.
    std::size_t feet = 0;             ///< number of perpendiculars computed for the choice
    /// The number of their feet outside the triangle, by the strict test 0 < a, b, c < 1.
    std::size_t feet_outside = 0;
    PaperSums sums; ///< by all measures, not only the one that chose
};

/// Iterative edge contraction as printed in the paper: the shortest edge first, to the best of both ends and the
/// midpoint, without any test that keeps a manifold. Takes any mesh.
PaperResult paper_simplified(const TriangleMesh& original, const PaperOptions& options);

} // namespace octant::models::simplify
