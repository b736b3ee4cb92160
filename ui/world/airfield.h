#pragma once

#include "models/heights/runway_strip.h"
#include "ui/settings/settings.h"
#include "ui/world/flight.h"
#include "ui/world/scene_ground.h"

#include <memory>
#include <optional>

namespace octant::ui::world {

/// Finds the runway of a run where its first aircraft begins, along the way it looks, or near there; null where the
/// settings ask for none. `script`: nothing where others fly the aircraft. `given_placement` is set to where its path
/// lies over the ground as it was. All must outlive it.
RunwayFinder make_runway_finder(const settings::RunSettings& settings, const std::optional<LoadedPath>& script,
    std::optional<PathPlacement>& given_placement);

/// Says where it lies already; null where there is none.
RunwayFinder fixed_runway_finder(std::shared_ptr<const models::heights::RunwayStrip> runway);

} // namespace octant::ui::world
