#pragma once

#include "sim/trajectory.h"
#include "ui/settings/flown_aircraft.h"
#include "ui/settings/settings.h"
#include "ui/world/flight.h"
#include "ui/world/loaded_path.h"
#include "ui/world/scene_ground.h"

#include <glm/vec2.hpp>

#include <string>
#include <vector>

namespace octant::ui::world {

/// The first aircraft's path: its own, or that of the settings.
std::string path_of(const settings::RunSettings& settings);

/// Lays the first aircraft's path over the ground, and with it all that a tape has beside it. Adds
/// what a person should be told to the notes. Throws Error.
Flight place_flight(
    const settings::RunSettings& settings,
    LoadedPath loaded,
    const SceneGround& ground,
    std::vector<std::string>& notes);

/// An aircraft's own path over the ground: it begins at this place, turned as the first one's,
/// unless it knows where it was flown. Throws Error.
sim::Trajectory own_path(
    const settings::RunSettings& settings,
    const settings::FlownAircraft& flown,
    const glm::dvec2& begin_m,
    const SceneGround& ground,
    const Flight& first,
    std::vector<std::string>& notes);

} // namespace octant::ui::world
