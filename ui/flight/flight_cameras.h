#pragma once

#include "ui/settings/settings.h"
#include "visuals/scene/camera.h"

#include <glm/vec3.hpp>

#include <vector>

namespace octant::ui::flight {

/// From where one frame of a run is seen.
struct FlightCamera {
    visuals::scene::Camera camera;
    /// Where the first aircraft is.
    glm::dvec3 aircraft_m{0.0};
    /// The radius of a sphere around it.
    double aircraft_radius_m = 0.0;
};

/// The cameras of all frames of a run, where a session with these settings has them. Loads the world. Throws Error.
std::vector<FlightCamera> flight_cameras(const settings::RunSettings& settings);

} // namespace octant::ui::flight
