#pragma once

#include "models/simplify/simplify.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <cstdint>

namespace octant::models::simplify {

/// The error measures that the 2005 paper compares.
enum class PaperMeasure {
    Plane,        ///< previous: squared distances to planes, as quadrics
    Triangle,     ///< proposed: to the triangles, one direction
    Bidirectional ///< proposed: the larger one of both directions
};

struct PaperOptions {
    PaperMeasure measure = PaperMeasure::Bidirectional;
    Goal goal;                          ///< vertices: unreferenced ones are counted, as printed
    std::size_t uncounted = 0;          ///< vertices that the file had and no triangle uses
    double colour_weight = 0.0;         ///< w of distances in (position, w rgb); 0 = position only
    bool colour_in_edge_length = false; ///< the shortest edge is looked for in 6-D too
    ShowProgress show_progress;
};

struct PaperResult {
    TriangleMesh mesh;
    std::size_t contractions = 0;
    std::size_t feet = 0;         ///< perpendiculars dropped on triangles
    std::size_t feet_outside = 0; ///< whose foot lies outside, by the strict test 0 < a, b, c < 1
    double error_sum_m2 = 0.0;    ///< chosen measure, over all contractions
    double plane_sum_m2 = 0.0;    ///< for comparison: see the table of the paper
};

/// Iterative edge contraction as printed in the paper: shortest edge first, best of both ends and
/// the middle, no test that keeps a manifold.
PaperResult paper_simplified(const TriangleMesh& original, const PaperOptions& options);

} // namespace octant::models::simplify
