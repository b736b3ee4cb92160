#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace octant::models::measure {

/// A triangle in the coordinates of its own plane: corner a is the origin and corner b lies on the x axis. In single
/// precision; `Number` is float, or a vector of floats for several triangles side by side.
template <typename Number>
struct PlaneFrame {
    std::array<Number, 3> origin;
    std::array<Number, 3> x_axis;
    std::array<Number, 3> y_axis;
    std::array<Number, 3> normal;
    Number bx, cx, cy;
    Number per_ab2, per_bc2, per_ca2; ///< 1 / length^2 of each edge; 0 for an edge without length.
};

/// The frame of a triangle. One without height gets any plane through its longest edges, and one without length any
/// plane at all. Corners are displaced by the rounding to float and by at most 1e-8 of an edge.
PlaneFrame<float> plane_frame(const std::array<glm::dvec3, 3>& corners);

inline std::array<float, 3> narrow(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// Results go out by reference: vectors as return values would depend on the processor's ABI.
#define OCTANT_INLINE [[gnu::always_inline]] inline

/// Sets `value` to the smaller one, lane by lane.
template <typename F>
OCTANT_INLINE void make_least(F& value, const F& other) {
    value = other < value ? other : value;
}

/// Clamps to 0..1, lane by lane.
template <typename F>
OCTANT_INLINE void clamp_unit(F& value) {
    value = value > 0.0F ? value : F{};
    value = value < 1.0F ? value : F{} + 1.0F;
}

/// Computes the normals of frames and 1 / length^2 of their edges from the rest.
template <typename F>
OCTANT_INLINE void finish_frame(PlaneFrame<F>& t) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t next = (axis + 1) % 3;
        const std::size_t last = (axis + 2) % 3;
        t.normal[axis] = t.x_axis[next] * t.y_axis[last] - t.x_axis[last] * t.y_axis[next];
    }
    const auto inverse = [](F& value, const F& length2) { value = length2 > 1e-30F ? 1.0F / length2 : F{}; };
    const F ex = t.cx - t.bx;
    inverse(t.per_ab2, t.bx * t.bx);
    inverse(t.per_bc2, ex * ex + t.cy * t.cy);
    inverse(t.per_ca2, t.cx * t.cx + t.cy * t.cy);
}

/// The vectors from the nearest point of the triangle's edges to a point, both in the plane of the triangle.
template <typename F>
struct EdgeFeet {
    F away_x, away_y, away2;
};

/// Finds the nearest point on the edges for a point (x, y) of the plane. away_x and away_y are filled only
/// `with_place`.
template <bool with_place, typename F, typename Number>
OCTANT_INLINE void nearest_on_edges(EdgeFeet<F>& feet, const F& x, const F& y, const PlaneFrame<Number>& t) {
    const F qx = x - t.bx;
    const Number ex = t.cx - t.bx;
    F ab = x * (t.bx * t.per_ab2);
    F bc = (qx * ex + y * t.cy) * t.per_bc2;
    F ca = (x * t.cx + y * t.cy) * t.per_ca2;
    clamp_unit(ab);
    clamp_unit(bc);
    clamp_unit(ca);
    const F ab_x = x - ab * t.bx;
    const F bc_x = qx - bc * ex;
    const F bc_y = y - bc * t.cy;
    const F ca_x = x - ca * t.cx;
    const F ca_y = y - ca * t.cy;
    const F ab2 = ab_x * ab_x + y * y;
    const F bc2 = bc_x * bc_x + bc_y * bc_y;
    const F ca2 = ca_x * ca_x + ca_y * ca_y;
    feet.away2 = ab2;
    make_least(feet.away2, bc2);
    if constexpr (with_place) {
        const auto is_bc = bc2 < ab2;
        const auto is_ca = ca2 < feet.away2;
        feet.away_x = is_bc ? bc_x : ab_x;
        feet.away_y = is_bc ? bc_y : y;
        feet.away_x = is_ca ? ca_x : feet.away_x;
        feet.away_y = is_ca ? ca_y : feet.away_y;
    }
    make_least(feet.away2, ca2);
}

/// A point in the coordinates of a triangle's plane, and its distance from the triangle.
template <typename F>
struct FramePoints {
    F x, y, distance2;
    /// Where the foot of the perpendicular lies inside the triangle, away_x and away_y are 0.
    EdgeFeet<F> feet;
};

/// Transforms a point into the frame of a triangle and finds its squared distance from the triangle.
template <bool with_place, typename F, typename Number>
OCTANT_INLINE void find_in_frame(FramePoints<F>& found, const std::array<F, 3>& place, const PlaneFrame<Number>& t) {
    const F dx = place[0] - t.origin[0];
    const F dy = place[1] - t.origin[1];
    const F dz = place[2] - t.origin[2];
    found.x = dx * t.x_axis[0] + dy * t.x_axis[1] + dz * t.x_axis[2];
    found.y = dx * t.y_axis[0] + dy * t.y_axis[1] + dz * t.y_axis[2];
    const F h = dx * t.normal[0] + dy * t.normal[1] + dz * t.normal[2];
    nearest_on_edges<with_place>(found.feet, found.x, found.y, t);
    F inside = found.y;
    make_least(inside, F((t.cx - t.bx) * found.y - t.cy * (found.x - t.bx)));
    make_least(inside, F(t.cy * found.x - t.cx * found.y));
    const auto is_inside = inside >= 0.0F;
    found.distance2 = (is_inside ? F{} : found.feet.away2) + h * h;
    if constexpr (with_place) {
        found.feet.away_x = is_inside ? F{} : found.feet.away_x;
        found.feet.away_y = is_inside ? F{} : found.feet.away_y;
    }
}

} // namespace octant::models::measure
