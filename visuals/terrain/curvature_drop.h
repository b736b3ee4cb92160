#pragma once

namespace octant::visuals::terrain {

/// 1 / (2 R); 0 for R = 0, which stands for a flat earth.
inline double half_curvature(double radius_m) { return radius_m > 0.0 ? 0.5 / radius_m : 0.0; }

/// By how much the ground is lowered at a horizontal distance d from the eye, given as its square: d^2 / (2 R).
inline double curvature_drop_m(double distance_squared_m2, double radius_m) {
    return half_curvature(radius_m) * distance_squared_m2;
}

} // namespace octant::visuals::terrain
