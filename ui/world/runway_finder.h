#pragma once

#include "models/heights/runway_strip.h"
#include "ui/settings/settings.h"
#include "ui/world/path_loader.h"
#include "ui/world/path_placement.h"
#include "ui/world/scene_ground.h"

#include <memory>
#include <optional>

namespace octant::ui::world {

/// Finds the runway of a run where its first aircraft begins, along its heading, or near there; null where the settings
/// ask for none. `script`: nothing where others fly the aircraft. When the finder runs it sets `given_placement` to
/// where the path lies over the ground that is not levelled yet. All arguments must outlive the finder.
RunwayFinder make_runway_finder(const settings::RunSettings& settings, const std::optional<LoadedPath>& script,
    std::optional<PathPlacement>& given_placement);

/// A finder that returns this runway; null if it is null.
RunwayFinder fixed_runway_finder(std::shared_ptr<const models::heights::RunwayStrip> runway);

} // namespace octant::ui::world
