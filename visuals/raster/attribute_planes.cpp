#include "visuals/raster/attribute_planes.h"

#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::raster {

namespace {

// As OpenGL's polygon offset in visuals/gl: a shadow piece lies in the plane of ground triangles,
// but for the rounding of its corners and depths.
constexpr double towards_eye_px = 1.0;
constexpr double towards_eye_share = 0x1p-19; ///< of the depth
// What is edge-on has depths without meaning and closes holes: it is pushed back.
constexpr double edge_on_share = 0.02;

} // namespace

PlaneSolver::PlaneSolver(const std::array<ClipPosition, 3>& vertices, const Projection& projection)
    : half_px_(projection.half_px) {
    glm::dmat3 rows; // of corners: glm counts columns first, so this is the transpose
    for (glm::length_t i = 0; i < 3; ++i) {
        const ClipPosition& vertex = vertices[static_cast<std::size_t>(i)];
        rows[0][i] = static_cast<double>(vertex.x);
        rows[1][i] = static_cast<double>(vertex.y);
        rows[2][i] = static_cast<double>(vertex.w);
    }
    const double determinant = glm::determinant(rows);
    if (determinant != 0.0) {
        from_values_ = glm::inverse(rows);
    }
}

AttributePlane PlaneSolver::plane(const glm::dvec3& values) const {
    const glm::dvec3 factor = from_values_ * values;
    AttributePlane plane;
    plane.per_x = factor.x / half_px_.x;
    plane.per_y = -factor.y / half_px_.y;
    plane.base = factor.z - factor.x + factor.y + 0.5 * (plane.per_x + plane.per_y);
    return plane;
}

void set_depth(
    TriangleExtra& extra,
    const AttributePlane& over_w,
    const DrawStyle& style,
    const Projection& projection) {
    const auto near_m = static_cast<double>(projection.near_m);
    if (style.depth == scene::DepthUse::InfinitelyFar) {
        extra.depth = {};
        return;
    }
    extra.depth = {over_w.base * near_m, over_w.per_x * near_m, over_w.per_y * near_m};
    if (style.depth == scene::DepthUse::OnGround) {
        const double slope = std::max(std::abs(extra.depth.per_x), std::abs(extra.depth.per_y));
        extra.depth.base += towards_eye_px * slope;
        extra.depth_share = static_cast<float>(1.0 + towards_eye_share);
    } else if (style.depth == scene::DepthUse::EdgeOn) {
        extra.depth_share = static_cast<float>(1.0 - edge_on_share);
    }
}

ClipLine clip_line(
    const glm::vec4& plane,
    const AttributePlane& over_w,
    const scene::FramePlan& plan,
    const Projection& projection) {
    const glm::dvec3 normal =
        glm::dmat3(glm::mat3(plan.world_to_view)) * glm::dvec3(glm::vec3(plane));
    const double across = 1.0 / static_cast<double>(plan.view_to_clip[0][0]);
    const double up = 1.0 / static_cast<double>(plan.view_to_clip[1][1]);
    const auto offset = static_cast<double>(plane.w);
    ClipLine line;
    line.a = normal.x * across / static_cast<double>(projection.half_px.x);
    line.b = -normal.y * up / static_cast<double>(projection.half_px.y);
    line.c = -normal.x * across + normal.y * up - normal.z + 0.5 * (line.a + line.b);
    // The picture's middle need not lie straight ahead.
    line.c += normal.x * across * static_cast<double>(plan.view_to_clip[2][0]) +
              normal.y * up * static_cast<double>(plan.view_to_clip[2][1]);
    line.a += offset * over_w.per_x;
    line.b += offset * over_w.per_y;
    line.c += offset * over_w.base;
    return line;
}

} // namespace octant::visuals::raster
