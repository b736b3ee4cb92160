#pragma once

#include "ui/world/world.h"

#include <span>
#include <string>
#include <vector>

namespace octant::ui::world {

/// What a person should be told who asked for detail or scenery near the eye on ground that cannot show it. `given`:
/// names of the options that stand on the command line.
std::vector<std::string> near_detail_warnings(
    const World& world, const visuals::scene::GroundSettings& settings, std::span<const std::string> given);

} // namespace octant::ui::world
