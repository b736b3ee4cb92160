#include "ui/studies/draw_order/renderer_comparer.h"

#include "ui/flight/make_renderer.h"

#include <utility>
#include <vector>

namespace octant::ui::studies::draw_order {

namespace scene = visuals::scene;

RendererComparer::RendererComparer(const settings::RunSettings& settings, const RayRenderer& rays)
    : settings_(settings)
    , rays_(rays)
    , unrounded_(settings.view.size_px) {
    for (std::size_t i = 0; i < renderers_.size(); ++i) {
        settings::RunSettings own = settings;
        own.drawing.renderer = compared_renderers[i];
        renderers_[i] = flight::make_renderer(own);
    }
}

std::unique_ptr<scene::Renderer> RendererComparer::sibling(const glm::ivec2& size_px, int) const {
    settings::RunSettings own = settings_;
    own.view.size_px = size_px;
    return std::make_unique<RendererComparer>(own, rays_);
}

void RendererComparer::resize(const glm::ivec2& size_px, std::optional<int> samples) {
    settings_.view.size_px = size_px;
    for (const auto& renderer : renderers_) {
        renderer->resize(size_px, samples);
    }
    unrounded_.resize(size_px, samples);
}

void RendererComparer::load_models(std::span<const scene::ModelBuffers> models) {
    for (const auto& renderer : renderers_) {
        renderer->load_models(models);
    }
    unrounded_.load_models(models);
}

void RendererComparer::load_ground_texture(const scene::GroundTexture& texture) {
    for (const auto& renderer : renderers_) {
        renderer->load_ground_texture(texture);
    }
}

void RendererComparer::warm_up() {
    for (const auto& renderer : renderers_) {
        renderer->warm_up();
    }
}

void RendererComparer::draw(const scene::FramePlan& plan) {
    is_unrounded_drawn_ = false;
    for (std::size_t i = renderers_.size(); i-- > 0;) {
        renderers_[i]->draw(plan);
        renderers_[i]->finish_and_read(picture_);
        differences_[i] = difference_to_rays(plan, picture_);
    }
}

RayRenderer::Difference
RendererComparer::difference_to_rays(const scene::FramePlan& plan, const scene::Picture& picture) {
    RayRenderer::Difference difference = rays_.compare(picture, rounding_reach_px);
    if (!difference.wrong.empty() && !std::exchange(is_unrounded_drawn_, true)) {
        unrounded_.draw(plan);
    }
    std::erase_if(difference.wrong, [&](const RayRenderer::WrongPixel& pixel) {
        return unrounded_.is_rounding(
            pixel.at, pixel.number, rays_.number_of(pixel.at), rounding_reach_px);
    });
    return difference;
}

} // namespace octant::ui::studies::draw_order
