#include "ui/flight/renderer_choice.h"

#include "sim/base/thread_pool.h"
#include "visuals/gl/gl_renderer.h"

#include <utility>

namespace octant::ui::flight {

namespace gl = visuals::gl;
namespace raster = visuals::raster;
using visuals::scene::Renderer;

namespace {

gl::OffscreenContext context_of(settings::ContextKind kind) {
    using enum settings::ContextKind;
    return kind == Egl      ? gl::OffscreenContext::Egl
           : kind == Window ? gl::OffscreenContext::HiddenWindow
                            : gl::OffscreenContext::OsMesa;
}

} // namespace

std::unique_ptr<raster::Renderer> make_raster_renderer(
    const settings::RunSettings& settings, std::shared_ptr<visuals::scene::WindowPicture> window) {
    const int threads = settings.drawing.raster_threads.value_or(core_count());
    return std::make_unique<raster::Renderer>(std::make_shared<ThreadPool>(threads), settings.view.size_px,
        settings.view.samples.value_or(16), std::move(window));
}

std::unique_ptr<Renderer> make_renderer(const settings::RunSettings& settings) {
    using settings::RendererKind;
    const RendererKind wanted = settings.drawing.renderer;
    const bool may_be_gpu = settings.drawing.context != settings::ContextKind::OsMesa;
    if (wanted == RendererKind::Raster || (wanted == RendererKind::Auto && !may_be_gpu)) {
        return make_raster_renderer(settings);
    }
    std::unique_ptr<Renderer> renderer = gl::make_gl_renderer(
        context_of(settings.drawing.context), settings.view.size_px, settings.view.samples.value_or(1));
    const bool no_gpu = renderer->info().is_software;
    return wanted == RendererKind::Auto && no_gpu ? make_raster_renderer(settings) : std::move(renderer);
}

} // namespace octant::ui::flight
