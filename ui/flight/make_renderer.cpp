#include "ui/flight/make_renderer.h"

#include "visuals/gl/make_renderer.h"

namespace octant::ui::flight {

namespace gl = visuals::gl;

std::unique_ptr<visuals::scene::Renderer> make_renderer(const settings::RunSettings& settings) {
    const glm::ivec2 size_px = settings.view.size_px;
    const int samples = settings.view.samples;
    switch (settings.drawing.context) {
    case settings::ContextKind::Egl:
        return gl::make_egl_renderer(size_px, samples);
    case settings::ContextKind::Window:
        return gl::make_hidden_window_renderer(size_px, samples);
    case settings::ContextKind::OsMesa:
        break;
    }
    return gl::make_osmesa_renderer(size_px, samples);
}

} // namespace octant::ui::flight
