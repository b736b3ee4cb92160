#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace octant::visuals::scene {

/// An eye point and its lens. World axes: x east, y north, z up, metres.
struct Camera {
    glm::dvec3 eye_m{0.0};
    /// View axes are as in OpenGL: x right, y up, -z ahead.
    glm::dquat view_to_world{1.0, 0.0, 0.0, 0.0};
    /// Usually 45 degrees.
    double vertical_fov_rad = 0.785398163397448;
    double near_m = 0.5;
    /// The offset of the middle of the picture's plane to the right of and above straight ahead, in units of the
    /// plane's distance; the plane stays square to straight ahead. Its height is 2 tan(vertical_fov_rad / 2), as
    /// without offset.
    glm::dvec2 middle{0.0};
    /// Width over height of what a pixel covers.
    double pixel_aspect = 1.0;
};

/// An upright camera at `eye_m` that looks at `target_m`. A camera that looks straight up or down has north up; if both
/// points are equal it looks north.
Camera camera_looking_at(const glm::dvec3& eye_m, const glm::dvec3& target_m);

/// Rotation from the view axes of a camera that looks ahead in a body (right, up, back) to that body's own (ahead,
/// right, down).
glm::dquat body_from_view();

/// Rotation part of the view: eye-relative world vectors to view axes.
glm::mat4 world_to_view(const Camera& camera);

/// Perspective with the depth reversed (1 at the near plane, 0 at infinity) and no far plane, for clip depth 0..1.
/// `aspect` = width / height of the picture in pixels, here and below.
glm::mat4 view_to_clip(const Camera& camera, double aspect);

/// The pixels that a metre covers straight ahead at a distance of one metre, along the shorter side of pixels.
double focal_px(const Camera& camera, int picture_height_px);

/// The direction in which a camera looks, world axes.
glm::dvec3 view_direction(const Camera& camera);

/// The cosine of the angle between that and the farthest of the picture's corners.
double corner_cos(const Camera& camera, double aspect);

/// Planes of the view frustum through the eye, eye-relative world axes, unit normals pointing inside: left, right,
/// bottom, top. A point is inside when every dot product is >= 0.
std::array<glm::dvec3, 4> frustum_normals(const Camera& camera, double aspect);

/// False only if no part of a sphere, eye-relative, is inside such planes.
bool in_view(const glm::dvec3& centre_m, double radius_m, const std::array<glm::dvec3, 4>& frustum);

} // namespace octant::visuals::scene
