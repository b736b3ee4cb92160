#pragma once

#include "sim/aircraft_state.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/settings.h"
#include "visuals/scene/tower.h"

#include <glm/vec3.hpp>

namespace octant::visuals::scene {

/// What a view must know of the aircraft it shows.
struct Subject {
    /// The radius of the sphere around the reference point that holds the aircraft.
    double radius_m = 10.0;
    /// The pilot's eye in body axes.
    glm::dvec3 pilot_eye_m{0.0};
};

/// Where the views stand that do not follow the aircraft.
struct FixedViewpoints {
    Tower tower;
    glm::dvec3 free_eye_m{0.0};
    glm::dvec3 free_look_m{0.0};
};

/// What a view remembers from one simulation step to the next: a value, so that a run repeats.
struct RigState {
    /// A unit vector, ahead as the camera follows it; zero before the first step.
    glm::dvec3 lagging_forward{0.0};
};

/// Memory after one simulation step of the aircraft that is followed.
RigState next_rig_state(const RigState& memory, const sim::AircraftState& state);

/// The camera of a view at the state's time, turned and moved nearer as the settings say: the eye around the aircraft
/// (chase, orbit; no nearer than the sphere around it), else the look. Neither is turned past straight up or down. The
/// eye is lifted where it would be below the ground or within 2 m of it.
Camera camera_of(const ViewSettings& settings, const sim::AircraftState& state, const RigState& memory,
    const Subject& subject, const FixedViewpoints& points, const GroundHeight& ground);

} // namespace octant::visuals::scene
