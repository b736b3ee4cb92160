#pragma once

#include "visuals/scene/renderer.h"

#include <glm/vec2.hpp>

#include <memory>

// Renderers by OpenGL for whoever knows nothing of OpenGL. Each has a context of its own; picture size in pixels, 1 or
// 4 samples a pixel. All throw Error.

namespace octant::visuals::gl {

class Context;

/// By Mesa's off-screen library: a processor draws, no display is needed.
std::unique_ptr<scene::Renderer> make_osmesa_renderer(const glm::ivec2& size_px, int samples);

/// Without a display, on a GPU where there is one.
std::unique_ptr<scene::Renderer> make_egl_renderer(const glm::ivec2& size_px, int samples);

/// By the display's driver, in a window that is not shown.
std::unique_ptr<scene::Renderer> make_hidden_window_renderer(const glm::ivec2& size_px, int samples);

/// With a context that was made before.
std::unique_ptr<scene::Renderer> make_renderer(
    std::shared_ptr<Context> context, const glm::ivec2& size_px, int samples);

} // namespace octant::visuals::gl
