#pragma once

#include "models/simplify/foot_of_perpendicular.h"
#include "models/simplify/point6.h"

#include <array>

namespace octant::models::simplify {

/// Sum of squared distances to planes, as x A x + 2 b x + c with A symmetric.
class PlaneQuadric {
public:
    /// Of no plane.
    PlaneQuadric() = default;

    /// Of the plane in space through a triangle's corners; colours do not count. Nothing for a
    /// triangle without area.
    static PlaneQuadric of_plane(const Corners& triangle);

    /// Of the plane that a triangle spans in six dimensions, colours too.
    static PlaneQuadric of_coloured_plane(const Corners& triangle);

    void add(const PlaneQuadric& other);

    /// At least 0; rounding below is cut.
    double at(const Point6& x) const;

private:
    std::array<double, 21> a_{}; ///< upper triangle of A, row after row
    Point6 b_{};
    double c_ = 0.0;
};

} // namespace octant::models::simplify
