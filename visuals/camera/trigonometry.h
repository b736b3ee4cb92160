#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace octant::visuals::camera {

// Functions of angles that give the same bits on every processor, made of additions, multiplications, divisions and
// square roots alone: the mathematical library of a system chooses its code by the processor's instructions, and its
// last bits differ. Errors are below 4e-16 times the result or 4e-16, whichever is more.

/// The angle in 0 .. pi between the direction (along, across) and straight along; `across` must not be negative.
double angle_of(double along, double across);

/// Sine (y) and cosine (x) of an angle of any size, radians.
glm::dvec2 cosine_and_sine(double angle_rad);

/// The rotation by the angle |turn_rad|, radians, about the axis `turn_rad`; no rotation for 0, 0, 0.
glm::dquat rotation_by(const glm::dvec3& turn_rad);

} // namespace octant::visuals::camera
