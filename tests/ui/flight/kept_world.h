#pragma once

#include "ui/settings/settings.h"
#include "ui/world/world.h"

#include <optional>

namespace octant::tests {

/// Loads the world of these settings beside the one that was asked for before, so that what both have in common is
/// loaded once. Throws Error.
inline ui::world::World kept_world(const ui::settings::RunSettings& settings) {
    static std::optional<ui::world::World> last;
    last = ui::world::load_world(settings, ui::world::RenderDevice::Cpu, last ? &*last : nullptr);
    return *last;
}

} // namespace octant::tests
