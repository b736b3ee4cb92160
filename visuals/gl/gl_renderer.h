#pragma once

#include "visuals/scene/renderer.h"

#include <glm/vec2.hpp>

#include <memory>

// Makes OpenGL renderers without including anything of OpenGL. `size_px`: the picture; `samples`: 1 or 4 a pixel. Which
// renderer a run uses, this one or visuals/raster, is decided by make_renderer of ui/flight/renderer_choice.h.

namespace octant::visuals::gl {

class Context;

/// Contexts that show nothing.
enum class OffscreenContext {
    OsMesa,      ///< Mesa's off-screen library: a processor draws; needs no display
    Egl,         ///< a GPU if there is one; needs no display
    HiddenWindow ///< the driver of the display, in a window that is not shown
};

/// A renderer with a context of its own. Throws Error.
std::unique_ptr<scene::Renderer> make_gl_renderer(OffscreenContext context, const glm::ivec2& size_px, int samples);

/// A renderer that shares `context`. Throws Error.
std::unique_ptr<scene::Renderer> make_gl_renderer(
    std::shared_ptr<Context> context, const glm::ivec2& size_px, int samples);

} // namespace octant::visuals::gl
