#pragma once

#include "ui/settings/settings.h"
#include "visuals/raster/renderer.h"
#include "visuals/scene/renderer.h"

#include <memory>

namespace octant::ui::flight {

/// The raster renderer, whatever the settings ask for. Pictures are made in the memory of `window`, if there is one.
std::unique_ptr<visuals::raster::Renderer> make_raster_renderer(
    const settings::RunSettings& settings, std::shared_ptr<visuals::scene::WindowPicture> window = nullptr);

/// The renderer that the settings ask for. Throws Error.
std::unique_ptr<visuals::scene::Renderer> make_renderer(const settings::RunSettings& settings);

} // namespace octant::ui::flight
