#include "visuals/scene/camera.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::scene {

Camera camera_looking_at(const glm::dvec3& eye_m, const glm::dvec3& target_m) {
    const glm::dvec3 to_target_m = target_m - eye_m;
    const double distance_m = glm::length(to_target_m);
    const glm::dvec3 ahead =
        distance_m > 0.0 ? to_target_m / distance_m : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 sideways = glm::cross(ahead, glm::dvec3(0.0, 0.0, 1.0));
    const bool vertical = glm::length(sideways) < 1e-9;
    const glm::dvec3 right =
        glm::normalize(vertical ? glm::cross(ahead, glm::dvec3(0.0, 1.0, 0.0)) : sideways);
    Camera camera;
    camera.eye_m = eye_m;
    camera.view_to_world =
        glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(right, ahead), -ahead)));
    return camera;
}

glm::mat4 world_to_view(const Camera& camera) {
    return glm::mat4(glm::mat4_cast(glm::conjugate(camera.view_to_world)));
}

glm::mat4 view_to_clip(const Camera& camera, double aspect) {
    const double scale = 1.0 / std::tan(camera.vertical_fov_rad / 2.0);
    glm::mat4 clip(0.0F);
    clip[0][0] = static_cast<float>(scale / aspect);
    clip[1][1] = static_cast<float>(scale);
    clip[2][3] = -1.0F;                             // w = distance ahead
    clip[3][2] = static_cast<float>(camera.near_m); // z / w = near / distance
    return clip;
}

double focal_px(const Camera& camera, int picture_height_px) {
    return picture_height_px / (2.0 * std::tan(camera.vertical_fov_rad / 2.0));
}

glm::dvec3 ahead_of(const Camera& camera) {
    return camera.view_to_world * glm::dvec3(0.0, 0.0, -1.0);
}

double corner_cos(const Camera& camera, double aspect) {
    const double half_height = std::tan(camera.vertical_fov_rad / 2.0); // at distance 1
    return 1.0 / std::sqrt(1.0 + half_height * half_height * (1.0 + aspect * aspect));
}

std::array<glm::dvec3, 4> frustum_normals(const Camera& camera, double aspect) {
    const double half_height = std::tan(camera.vertical_fov_rad / 2.0); // at distance 1
    const double half_width = half_height * aspect;
    const auto in_world = [&](const glm::dvec3& in_view) {
        return camera.view_to_world * glm::normalize(in_view);
    };
    return {
        in_world({1.0, 0.0, -half_width}),
        in_world({-1.0, 0.0, -half_width}),
        in_world({0.0, 1.0, -half_height}),
        in_world({0.0, -1.0, -half_height})};
}

bool in_view(
    const glm::dvec3& centre_m, double radius_m, const std::array<glm::dvec3, 4>& frustum) {
    return std::ranges::all_of(
        frustum, [&](const glm::dvec3& normal) { return glm::dot(normal, centre_m) >= -radius_m; });
}

} // namespace octant::visuals::scene
