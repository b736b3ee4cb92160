#pragma once

#include "ui/settings/settings.h"
#include "visuals/scene/renderer.h"

#include <memory>

namespace octant::ui::flight {

/// The renderer that the settings ask for. Throws Error.
std::unique_ptr<visuals::scene::Renderer> make_renderer(const settings::RunSettings& settings);

} // namespace octant::ui::flight
