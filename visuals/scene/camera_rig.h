#pragma once

#include "sim/aircraft_state.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/settings.h"
#include "visuals/scene/tower.h"

#include <glm/vec3.hpp>

namespace octant::visuals::scene {

/// The properties of the aircraft that a view shows.
struct Subject {
    /// The radius of the sphere around the reference point that holds the aircraft.
    double radius_m = 10.0;
    /// The pilot's eye in body axes.
    glm::dvec3 pilot_eye_m{0.0};
};

/// The eye points of views that do not follow the aircraft.
struct FixedViewpoints {
    Tower tower;
    glm::dvec3 free_eye_m{0.0};
    glm::dvec3 free_look_m{0.0};
};

/// The memory of a view from one simulation step to the next. A plain value, so that a run can be repeated.
struct RigState {
    /// A unit vector, ahead as the camera follows it; zero before the first step.
    glm::dvec3 lagging_forward{0.0};
};

/// The memory after one simulation step of the aircraft that the view follows.
RigState next_rig_state(const RigState& memory, const sim::AircraftState& state);

/// The camera of a view at the state's time. The settings turn and zoom it: in chase and orbit views they move the eye
/// around the aircraft, no nearer than the sphere around it; in others they turn the direction of view. Neither turns
/// past straight up or down. The eye is kept at least 2 m above the ground.
Camera camera_of(const ViewSettings& settings, const sim::AircraftState& state, const RigState& memory,
    const Subject& subject, const FixedViewpoints& points, const GroundHeight& ground);

} // namespace octant::visuals::scene
