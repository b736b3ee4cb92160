#pragma once

#include "ui/settings/settings.h"
#include "ui/world/world.h"

#include <functional>
#include <octant/octant.h>
#include <string_view>

namespace octant::ui::library {

// What modules of this program may know of a public World besides its interface. Not installed.

/// What was loaded for it. Valid as long as the world or a copy of it.
const world::World& loaded_world(const World& world);

/// The settings it was loaded by: those of views and frames are the defaults.
const settings::RunSettings& settings_of(const World& world);

/// Loads a world by settings of any run; those of views and frames are not used, but for the path's start. `shared`:
/// what it has loaded of the same inputs is not loaded again; null = nothing. `on_note`: told about what is guessed or
/// mended; empty = std::clog. Throws Error.
World make_world(const settings::RunSettings& settings, const World* shared = nullptr,
    const std::function<void(std::string_view)>& on_note = nullptr);

} // namespace octant::ui::library
