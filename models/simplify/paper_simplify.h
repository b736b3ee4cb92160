#pragma once

#include "models/simplify/simplify_options.h"
#include "models/triangle_mesh.h"

#include <cstddef>

namespace octant::models::simplify {

/// The error measures that the 2005 paper compares.
enum class PaperMeasure {
    Plane,        ///< The previous measure: squared distances to planes, as quadrics.
    Triangle,     ///< Proposed: squared distances to triangles, in one direction.
    Bidirectional ///< Proposed: the larger one of both directions.
};

/// How to simplify as printed in the paper.
struct PaperOptions {
    PaperMeasure measure = PaperMeasure::Bidirectional;
    /// Vertices or faces; error_m must be empty (asserted). As in the paper, vertices that no
    /// triangle uses are counted.
    Goal goal;
    std::size_t uncounted = 0; ///< How many such vertices of the file the mesh no longer has.
    /// w of distances in the six dimensions (position, w rgb), in metres; 0 = position only.
    double colour_weight = 0.0;
    /// The shortest edge is searched for in six dimensions, too.
    bool colour_in_edge_length = false;
    ShowProgress show_progress;
};

/// The costs of the chosen contractions, each against the mesh before it, summed over all of them:
/// the paper's error, in square metres.
struct PaperSums {
    double plane_m2 = 0.0;         ///< Quadrics at the new vertices.
    double triangle_m2 = 0.0;      ///< From the new vertices to the triangles that they replace.
    double bidirectional_m2 = 0.0; ///< The larger one of that and the opposite direction.
};

/// The simplified mesh and what the paper's tables tell about it.
struct PaperResult {
    TriangleMesh mesh;
    std::size_t contractions = 0;
    std::size_t counted_vertices = 0; ///< How many vertices are left, as the paper counts them.
    std::size_t feet = 0; ///< How many perpendiculars were dropped on triangles to choose.
    /// How many of their feet lie outside, by the strict test 0 < a, b, c < 1.
    std::size_t feet_outside = 0;
    PaperSums sums; ///< By all measures, whichever of them chose.
};

/// Iterative edge contraction as printed in the paper: the shortest edge first, to the best of both
/// ends and the midpoint, without any test that keeps a manifold. Takes any mesh.
PaperResult paper_simplified(const TriangleMesh& original, const PaperOptions& options);

} // namespace octant::models::simplify
