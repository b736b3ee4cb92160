#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <functional>
#include <optional>

namespace octant {

/// The height of the ground at world x (east), y (north), metres; nothing outside the map.
using GroundHeight = std::function<std::optional<double>(double x_m, double y_m)>;

// World: flat ground, x east, y north, z up, metres from the map centre at datum (EarthFrame).
// Body:  x forward, y right, z down, metres from the aircraft's reference point.

/// Attitude in radians. Heading clockwise from true north in [0, 2 pi), pitch nose up in [-pi/2, pi/2], roll right wing
/// down in (-pi, pi].
struct EulerAngles {
    double heading_rad = 0.0;
    double pitch_rad = 0.0;
    double roll_rad = 0.0;
};

/// Rotation that takes a body vector to the world. All angles 0 = level, nose north.
glm::dquat body_to_world_from_euler(const EulerAngles& angles);

/// Inverse of body_to_world_from_euler. At pitch +-90 degrees heading and roll are not unique: roll comes back as 0.
EulerAngles euler_from_body_to_world(const glm::dquat& body_to_world);

/// Unit vector of a compass direction, level. 0 = north (0, 1, 0), pi/2 = east (1, 0, 0).
glm::dvec3 direction_from_heading(double heading_rad);

/// A level vector, x east and y north, turned clockwise seen from above.
glm::dvec2 rotated_clockwise(const glm::dvec2& east_north, double by_rad);

/// Twice the area of the triangle that two vectors span: positive where `b` lies to the left of `a`.
inline double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The same angle in [0, 2 pi).
double wrapped_to_two_pi(double angle_rad);

/// The same angle in (-pi, pi].
double wrapped_to_pi(double angle_rad);

} // namespace octant
