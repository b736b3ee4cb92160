#pragma once

#include "ui/world/world.h"

#include <glm/vec3.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::world {

/// What a person should be told who asked for detail or scenery near the eye on ground that cannot
/// show it. `given`: names of the options that stand on the command line.
std::vector<std::string> near_ground_notes(
    const World& world,
    const visuals::scene::GroundSettings& settings,
    std::span<const std::string> given);

/// What a person should be told whose eye point lies under the ground, which is so high there;
/// nothing where it does not.
std::optional<std::string>
note_of_low_eye(const glm::dvec3& eye_m, const std::optional<double>& ground_m);

} // namespace octant::ui::world
