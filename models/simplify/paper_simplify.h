#pragma once

#include "models/simplify/simplify_options.h"
#include "models/triangle_mesh.h"

#include <cstddef>

namespace octant::models::simplify {

/// The error measures that the 2005 paper compares.
enum class PaperMeasure {
    Plane,        ///< previous: squared distances to planes, as quadrics
    Triangle,     ///< proposed: to the triangles, one direction
    Bidirectional ///< proposed: the larger one of both directions
};

struct PaperOptions {
    PaperMeasure measure = PaperMeasure::Bidirectional;
    Goal goal;                  ///< vertices or faces (error_m means nothing here); vertices
                                ///< that no triangle uses are counted, as printed
    std::size_t uncounted = 0;  ///< such vertices of the file that the mesh no longer has
    double colour_weight = 0.0; ///< w of distances in (position, w rgb), metres; 0 = position only
    bool colour_in_edge_length = false; ///< the shortest edge is looked for in 6-D too
    ShowProgress show_progress;
};

/// What the chosen contractions cost, each against the mesh before it, summed over all of them.
/// In square metres: squared distances.
struct PaperSums {
    double plane_m2 = 0.0;         ///< quadrics at the new vertices
    double triangle_m2 = 0.0;      ///< new vertices to the triangles they replace
    double bidirectional_m2 = 0.0; ///< the larger one of that and the way back
};

struct PaperResult {
    TriangleMesh mesh;
    std::size_t contractions = 0;
    std::size_t counted_vertices = 0; ///< that are left, as the paper counts them
    std::size_t feet = 0;             ///< perpendiculars dropped on triangles to choose
    std::size_t feet_outside = 0; ///< whose foot lies outside, by the strict test 0 < a, b, c < 1
    PaperSums sums;               ///< by every measure, whichever chose
};

/// Iterative edge contraction as printed in the paper: shortest edge first, best of both ends and
/// the middle, no test that keeps a manifold. Takes any mesh.
PaperResult paper_simplified(const TriangleMesh& original, const PaperOptions& options);

} // namespace octant::models::simplify
