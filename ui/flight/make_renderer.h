#pragma once

#include "ui/settings/settings.h"
#include "visuals/raster/renderer.h"
#include "visuals/scene/renderer.h"

#include <memory>

namespace octant::ui::flight {

/// The raster renderer, whatever the settings ask for. `show` puts its pictures into a window.
std::unique_ptr<visuals::raster::Renderer> make_raster_renderer(
    const settings::RunSettings& settings, visuals::raster::Renderer::Show show = nullptr);

/// The renderer that the settings ask for. Throws Error.
std::unique_ptr<visuals::scene::Renderer> make_renderer(const settings::RunSettings& settings);

} // namespace octant::ui::flight
