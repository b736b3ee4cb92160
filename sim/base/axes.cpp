#include "sim/base/axes.h"

#include "sim/base/units.h"

#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace octant {

glm::dquat body_to_world_from_euler(const EulerAngles& angles) {
    // Columns of the matrix are the body axes in the world for a level aircraft heading north.
    static const glm::dquat level_north =
        glm::quat_cast(glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1)));
    const glm::dquat yaw = glm::angleAxis(angles.heading_rad, glm::dvec3(0, 0, 1));
    const glm::dquat pitch = glm::angleAxis(angles.pitch_rad, glm::dvec3(0, 1, 0));
    const glm::dquat roll = glm::angleAxis(angles.roll_rad, glm::dvec3(1, 0, 0));
    return glm::normalize(level_north * yaw * pitch * roll);
}

EulerAngles euler_from_body_to_world(const glm::dquat& body_to_world) {
    const glm::dmat3 axes = glm::mat3_cast(glm::normalize(body_to_world));
    const glm::dvec3& forward = axes[0];
    const glm::dvec3& right = axes[1];
    const glm::dvec3& down = axes[2];
    EulerAngles angles;
    angles.pitch_rad = std::asin(std::clamp(forward.z, -1.0, 1.0));
    if (std::hypot(forward.x, forward.y) < 1e-9) {
        angles.heading_rad = wrapped_to_two_pi(std::atan2(-right.y, right.x));
        return angles;
    }
    angles.heading_rad = wrapped_to_two_pi(std::atan2(forward.x, forward.y));
    angles.roll_rad = wrapped_to_pi(std::atan2(-right.z, -down.z));
    return angles;
}

glm::dvec3 direction_from_heading(double heading_rad) { return {std::sin(heading_rad), std::cos(heading_rad), 0.0}; }

glm::dvec2 rotated_clockwise(const glm::dvec2& east_north, double by_rad) {
    const double cosine = std::cos(by_rad);
    const double sine = std::sin(by_rad);
    return {cosine * east_north.x + sine * east_north.y, cosine * east_north.y - sine * east_north.x};
}

double wrapped_to_two_pi(double angle_rad) {
    const double wrapped = std::fmod(angle_rad, 2.0 * pi);
    const double positive = wrapped < 0.0 ? wrapped + 2.0 * pi : wrapped;
    return positive >= 2.0 * pi ? 0.0 : positive;
}

double wrapped_to_pi(double angle_rad) {
    const double wrapped = wrapped_to_two_pi(angle_rad);
    return wrapped > pi ? wrapped - 2.0 * pi : wrapped;
}

} // namespace octant
