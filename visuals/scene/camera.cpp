#include "visuals/scene/camera.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::scene {

namespace {

/// The picture's plane at distance 1 from the eye: right and up.
struct Plane {
    glm::dvec2 middle{0.0};
    /// Half of its sides.
    glm::dvec2 half{1.0};
};

Plane plane_of(const Camera& camera, double aspect) {
    const double half_height = std::tan(camera.vertical_fov_rad / 2.0);
    return {camera.middle, {half_height * aspect * camera.pixel_aspect, half_height}};
}

} // namespace

Camera camera_looking_at(const glm::dvec3& eye_m, const glm::dvec3& target_m) {
    const glm::dvec3 to_target_m = target_m - eye_m;
    const double distance_m = glm::length(to_target_m);
    const glm::dvec3 ahead = distance_m > 0.0 ? to_target_m / distance_m : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 sideways = glm::cross(ahead, glm::dvec3(0.0, 0.0, 1.0));
    const bool vertical = glm::length(sideways) < 1e-9;
    const glm::dvec3 right = glm::normalize(vertical ? glm::cross(ahead, glm::dvec3(0.0, 1.0, 0.0)) : sideways);
    Camera camera;
    camera.eye_m = eye_m;
    camera.view_to_world = glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(right, ahead), -ahead)));
    return camera;
}

glm::mat4 world_to_view(const Camera& camera) {
    return glm::mat4(glm::mat4_cast(glm::conjugate(camera.view_to_world)));
}

glm::mat4 view_to_clip(const Camera& camera, double aspect) {
    const Plane plane = plane_of(camera, aspect);
    glm::mat4 clip(0.0F);
    clip[0][0] = static_cast<float>(1.0 / plane.half.x);
    clip[1][1] = static_cast<float>(1.0 / plane.half.y);
    clip[2][0] = static_cast<float>(plane.middle.x / plane.half.x);
    clip[2][1] = static_cast<float>(plane.middle.y / plane.half.y);
    clip[2][3] = -1.0F;                             // w = distance ahead
    clip[3][2] = static_cast<float>(camera.near_m); // z / w = near / distance
    return clip;
}

double focal_px(const Camera& camera, int picture_height_px) {
    const double up_px = picture_height_px / (2.0 * std::tan(camera.vertical_fov_rad / 2.0));
    return up_px / std::min(camera.pixel_aspect, 1.0);
}

glm::dquat body_from_view() {
    return glm::quat_cast(
        glm::dmat3(glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(-1.0, 0.0, 0.0)));
}

glm::dvec3 view_direction(const Camera& camera) { return camera.view_to_world * glm::dvec3(0.0, 0.0, -1.0); }

double corner_cos(const Camera& camera, double aspect) {
    const Plane plane = plane_of(camera, aspect);
    const glm::dvec2 corner = glm::abs(plane.middle) + plane.half;
    return 1.0 / std::sqrt(1.0 + glm::dot(corner, corner));
}

std::array<glm::dvec3, 4> frustum_normals(const Camera& camera, double aspect) {
    const Plane plane = plane_of(camera, aspect);
    const glm::dvec2 min = plane.middle - plane.half;
    const glm::dvec2 max = plane.middle + plane.half;
    const auto in_world = [&](const glm::dvec3& in_view) { return camera.view_to_world * glm::normalize(in_view); };
    return {in_world({1.0, 0.0, min.x}), in_world({-1.0, 0.0, -max.x}), in_world({0.0, 1.0, min.y}),
        in_world({0.0, -1.0, -max.y})};
}

bool in_view(const glm::dvec3& centre_m, double radius_m, const std::array<glm::dvec3, 4>& frustum) {
    return std::ranges::all_of(
        frustum, [&](const glm::dvec3& normal) { return glm::dot(normal, centre_m) >= -radius_m; });
}

} // namespace octant::visuals::scene
