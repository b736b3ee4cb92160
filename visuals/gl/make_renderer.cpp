#include "visuals/gl/make_renderer.h"

#include "visuals/gl/context.h"
#include "visuals/gl/renderer.h"
#include "visuals/gl/window_context.h"

#include <utility>

namespace octant::visuals::gl {

std::unique_ptr<scene::Renderer> make_osmesa_renderer(const glm::ivec2& size_px, int samples) {
    return make_renderer(make_osmesa_context(), size_px, samples);
}

std::unique_ptr<scene::Renderer> make_egl_renderer(const glm::ivec2& size_px, int samples) {
    return make_renderer(make_egl_context(), size_px, samples);
}

std::unique_ptr<scene::Renderer> make_hidden_window_renderer(const glm::ivec2& size_px, int samples) {
    return make_renderer(make_window_context({.visible = false}), size_px, samples);
}

std::unique_ptr<scene::Renderer> make_renderer(
    std::shared_ptr<Context> context, const glm::ivec2& size_px, int samples) {
    return std::make_unique<Renderer>(std::move(context), size_px, samples);
}

} // namespace octant::visuals::gl
