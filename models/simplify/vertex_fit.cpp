// The normal equations of one vertex. A point at distance d from the surface wants the surface to
// move by d along the direction to the point; the vertex takes part in that by its barycentric
// weight. Three equations result, slightly damped (Levenberg-Marquardt), so that a vertex in a flat
// surrounding does not slide.
#include "models/simplify/vertex_fit.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::models::simplify {

namespace {

/// The point of a triangle nearest to a point of its plane, in the plane's coordinates.
struct FlatFoot {
    double x = 0.0;
    double y = 0.0;
    bool inside = true;
};

/// Takes the nearest point on the edge from (ax, ay) along (ex, ey) where that is nearer than what
/// was found.
void take_edge(
    double x,
    double y,
    double ax,
    double ay,
    double ex,
    double ey,
    double per_length2,
    double& best2,
    FlatFoot& foot) {
    const double along = std::clamp(((x - ax) * ex + (y - ay) * ey) * per_length2, 0.0, 1.0);
    const double fx = ax + along * ex;
    const double fy = ay + along * ey;
    const double away2 = (x - fx) * (x - fx) + (y - fy) * (y - fy);
    if (away2 < best2) {
        best2 = away2;
        foot = {fx, fy, false};
    }
}

/// The point of a triangle nearest to the point (x, y) of its plane.
FlatFoot foot_of(double x, double y, const FlatTriangle& t) {
    const double bx = static_cast<double>(t.bx);
    const double cx = static_cast<double>(t.cx);
    const double cy = static_cast<double>(t.cy);
    if (y >= 0.0 && (cx - bx) * y - cy * (x - bx) >= 0.0 && cy * x - cx * y >= 0.0) {
        return {x, y, true};
    }
    FlatFoot foot;
    double best2 = std::numeric_limits<double>::infinity();
    take_edge(x, y, 0.0, 0.0, bx, 0.0, static_cast<double>(t.per_ab2), best2, foot);
    take_edge(x, y, bx, 0.0, cx - bx, cy, static_cast<double>(t.per_bc2), best2, foot);
    take_edge(x, y, 0.0, 0.0, cx, cy, static_cast<double>(t.per_ca2), best2, foot);
    return foot;
}

} // namespace

void VertexFit::add(const glm::dvec3& off, const glm::dvec3& normal, double share, double weight) {
    const double length2 = glm::dot(off, off);
    const glm::dvec3 direction = length2 > 1e-16 ? off / std::sqrt(length2) : normal;
    matrix_.add_plane(direction, 0.0, weight * share * share);
    const double along = sideways * weight * share * share;
    matrix_.xx += along;
    matrix_.yy += along;
    matrix_.zz += along;
    right_side_ += ((1.0 + sideways) * weight * share) * off;
}

void VertexFit::add_colour(
    const glm::dvec3& off, const std::array<glm::dvec3, 3>& gradient, double share, double weight) {
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3& slope = gradient[static_cast<std::size_t>(i)];
        matrix_.add_plane(slope, 0.0, weight * share * share);
        right_side_ -= (weight * share * off[i]) * slope;
    }
    colour_weight_ += weight * share * share;
    colour_sum_ += (weight * share) * off;
}

glm::dvec3 VertexFit::way() const {
    Quadric held = matrix_;
    const double hold = 1e-3 * matrix_.trace();
    held.xx += hold;
    held.yy += hold;
    held.zz += hold;
    return solved(held, right_side_, glm::dvec3(0.0));
}

glm::dvec3 VertexFit::colour_change() const {
    return colour_weight_ > 0.0 ? colour_sum_ / colour_weight_ : glm::dvec3(0.0);
}

void add_sample(
    VertexFit& fit,
    const SampleBlock& samples,
    std::size_t i,
    const FlatTriangle& t,
    double weight,
    bool coloured) {
    const glm::dvec3 d(
        static_cast<double>(samples.x[i]) - static_cast<double>(t.origin[0]),
        static_cast<double>(samples.y[i]) - static_cast<double>(t.origin[1]),
        static_cast<double>(samples.z[i]) - static_cast<double>(t.origin[2]));
    const glm::dvec3 x_axis = widen(t.x_axis);
    const glm::dvec3 y_axis = widen(t.y_axis);
    const FlatFoot foot = foot_of(glm::dot(d, x_axis), glm::dot(d, y_axis), t);
    const double c = t.cy > 0.0F ? foot.y / static_cast<double>(t.cy) : 0.0;
    const double b =
        t.bx > 0.0F ? (foot.x - c * static_cast<double>(t.cx)) / static_cast<double>(t.bx) : 0.0;
    const double share = std::clamp(1.0 - b - c, 0.0, 1.0);
    if (share <= 0.0) {
        return;
    }
    const glm::dvec3 off = d - foot.x * x_axis - foot.y * y_axis;
    fit.add(off, widen(t.normal), share, weight);
    if (coloured) {
        const glm::dvec3 colour(samples.red[i], samples.green[i], samples.blue[i]);
        const glm::dvec3 along_x = widen(t.colour_x);
        const glm::dvec3 along_y = widen(t.colour_y);
        const glm::dvec3 here = widen(t.colour) + foot.x * along_x + foot.y * along_y;
        std::array<glm::dvec3, 3> gradient{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
        for (int part = 0; foot.inside && part < 3; ++part) {
            gradient[static_cast<std::size_t>(part)] =
                along_x[part] * x_axis + along_y[part] * y_axis;
        }
        fit.add_colour(colour - here, gradient, share, weight);
    }
}

} // namespace octant::models::simplify
