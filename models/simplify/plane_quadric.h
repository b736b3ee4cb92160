#pragma once

#include "models/simplify/foot_of_perpendicular.h"
#include "models/simplify/point6.h"

#include <array>

namespace octant::models::simplify {

/// A quadric error metric in six dimensions: the sum of squared distances to planes, x^T A x + 2
/// b^T x + c with a symmetric A. The default one has no plane and is 0 everywhere.
class PlaneQuadric {
public:
    PlaneQuadric() = default;

    /// The quadric of the plane in space through a triangle's corners, whatever their colours; that
    /// of no plane for a triangle without area.
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

} // namespace octant::models::simplify
