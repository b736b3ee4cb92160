#pragma once

#include "ui/settings/settings.h"
#include "visuals/scene/planner.h"

#include <string>
#include <vector>

namespace octant::ui::world {

/// Loads the aircraft of a run, and the cockpit of the first one where it has one: polygon models
/// with their painting orders, chains of levels, and meshes, which get levels here. Returns what a
/// person should be told. Throws Error.
std::vector<std::string>
load_aircraft(const settings::Settings& settings, visuals::scene::Scene& scene);

} // namespace octant::ui::world
