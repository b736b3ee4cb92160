#pragma once

#include "sim/aircraft_state.h"
#include "visuals/scene/camera.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <octant/octant.h>
#include <optional>
#include <string_view>

namespace octant::ui::library {

// Values of the public interface as those of the other modules, checked: each function throws Error with `what` and
// the wrong value for numbers that are not finite or out of range.

inline Vec3 vec3_from(const glm::dvec3& value) { return {value.x, value.y, value.z}; }

inline Quaternion quaternion_from(const glm::dquat& value) { return {value.w, value.x, value.y, value.z}; }

glm::dvec3 checked_vector(std::string_view what, const Vec3& value);

/// A place on a map or above it.
glm::dvec3 checked_place(std::string_view what, const Vec3& value);

/// Of unit length.
glm::dquat checked_attitude(std::string_view what, const Quaternion& value);

void check_camera(const Camera& camera);

/// Sets the lens of `made` to that of a checked camera without distortion.
void set_lens(const Camera& camera, visuals::scene::Camera& made);

/// The lens and the place of a checked camera without distortion.
visuals::scene::Camera pinhole_camera(const Camera& camera, const Pose& pose);

/// The same at the previous pose; nothing where the pose names none.
std::optional<visuals::scene::Camera> previous_camera(const Camera& camera, const Pose& pose);

sim::AircraftState aircraft_state(const State& state);

State state_from(const sim::AircraftState& state);

} // namespace octant::ui::library
