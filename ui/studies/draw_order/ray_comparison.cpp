#include "ui/studies/draw_order/ray_comparison.h"

#include "ui/flight/session.h"
#include "ui/studies/draw_order/ray_renderer.h"

#include <fmt/format.h>
#include <memory>
#include <utility>

namespace octant::ui::studies::draw_order {

namespace scene = visuals::scene;
using flight::Session;
using flight::PictureContent;

namespace {

std::string text_of(const RayRenderer::WrongPixel& wrong, int frame) {
    return fmt::format(
        "frame {} at {},{}: {}",
        frame,
        wrong.at.x,
        wrong.at.y,
        wrong.nearer ? fmt::format("the ray's is nearer by {:.1e} of the depth", *wrong.nearer)
                     : "what is shown is not there");
}

} // namespace

long RayComparison::wrong() const {
    long sum = 0;
    for (const OfRenderer& one : renderers) {
        sum += one.wrong;
    }
    return sum;
}

void RayComparison::add(const RayComparison& other) {
    frames += other.frames;
    pixels += other.pixels;
    for (std::size_t i = 0; i < renderers.size(); ++i) {
        renderers[i].differing += other.renderers[i].differing;
        renderers[i].wrong += other.renderers[i].wrong;
    }
}

RayComparison compare_with_rays(
    const settings::RunSettings& settings,
    const flight::ComparisonWorlds& worlds,
    int every,
    const std::function<void(int compared, int frames)>& on_frame) {
    const auto [painted, depth_buffered] = flight::comparison_settings(settings);
    auto renderer = std::make_unique<RayRenderer>(settings.view.size_px);
    auto renderers = std::make_unique<RendererComparer>(painted, *renderer);
    const RendererComparer& comparer = *renderers;
    Session reference(depth_buffered, PictureContent::PolygonIds, std::move(renderer), worlds.depth_buffered);
    Session painter(painted, PictureContent::PolygonIds, std::move(renderers), worlds.painted);
    RayComparison sum;
    const int frames = (reference.frames() + every - 1) / every;
    for (int frame = 0; frame < reference.frames(); frame += every) {
        reference.draw(frame);
        painter.draw(frame);
        for (std::size_t i = 0; i < sum.renderers.size(); ++i) {
            const RayRenderer::Difference& difference = comparer.differences()[i];
            RayComparison::OfRenderer& own = sum.renderers[i];
            if (own.wrong == 0 && !difference.wrong.empty()) {
                own.first_wrong = text_of(difference.wrong.front(), frame);
            }
            own.differing += difference.differing;
            own.wrong += static_cast<long>(difference.wrong.size());
        }
        sum.pixels += static_cast<long>(settings.view.size_px.x) * settings.view.size_px.y;
        on_frame(++sum.frames, frames);
    }
    return sum;
}

} // namespace octant::ui::studies::draw_order
