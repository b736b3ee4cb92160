#pragma once

#include "sim/aircraft_state.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/settings.h"

#include <functional>
#include <optional>
#include <span>

namespace octant::visuals::scene {

/// Height of the ground below a world position, metres; nothing outside the map.
using GroundHeight = std::function<std::optional<double>(double x_m, double y_m)>;

/// What a view must know of the aircraft it shows.
struct Subject {
    double radius_m = 10.0;      ///< of the sphere around the reference point
    glm::dvec3 pilot_eye_m{0.0}; ///< body axes
};

/// Where the views stand that do not follow the aircraft.
struct FixedPoints {
    glm::dvec3 tower_m{0.0};
    glm::dvec3 free_eye_m{0.0};
    glm::dvec3 free_look_m{0.0};
};

/// What a view remembers from one simulation step to the next: a value, so that a run repeats.
struct RigMemory {
    glm::dvec3 lagging_forward{0.0}; ///< unit vector; zero before the first step
};

/// Memory after one simulation step of the aircraft that is followed.
RigMemory advanced(const RigMemory& memory, const sim::AircraftState& state);

/// The camera of a view at the state's time, turned and moved nearer as the settings say: the eye
/// around the aircraft (chase, orbit; no nearer than the sphere around it), else the look. Neither
/// is turned past straight up or down. The eye is lifted where it would be below the ground or
/// within 2 m of it.
Camera camera_of(
    const ViewSettings& settings,
    const sim::AircraftState& state,
    const RigMemory& memory,
    const Subject& subject,
    const FixedPoints& points,
    const GroundHeight& ground);

/// A good place for the tower: within half the flight's extent around `around_m` a spot, 25
/// m above the ground, from which as much of the flight is in sight as from any other (to 5 % of
/// it); among those the highest, so that ground stands behind the aircraft; among equals the
/// nearest.
glm::dvec3 tower_place(
    std::span<const glm::dvec3> flight_m, const glm::dvec2& around_m, const GroundHeight& ground);

} // namespace octant::visuals::scene
