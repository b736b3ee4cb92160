#include "ui/studies/draw_order/ray_comparison.h"

#include "ui/flight/session.h"
#include "ui/studies/draw_order/ray_renderer.h"

#include <fmt/format.h>
#include <memory>
#include <utility>

namespace octant::ui::studies::draw_order {

namespace scene = visuals::scene;
using flight::Session;
using flight::Shows;

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
    const flight::ComparedWorlds& worlds,
    int every,
    const std::function<void(int compared, int frames)>& seen) {
    const auto [painted, by_depth] = flight::compared_settings(settings);
    auto renderer = std::make_unique<RayRenderer>(settings.view.size_px);
    auto renderers = std::make_unique<JudgedRenderers>(painted, *renderer);
    const JudgedRenderers& judged = *renderers;
    Session reference(by_depth, Shows::PolygonNumbers, std::move(renderer), worlds.by_depth);
    Session painter(painted, Shows::PolygonNumbers, std::move(renderers), worlds.painted);
    RayComparison sum;
    const int frames = (reference.frames() + every - 1) / every;
    for (int frame = 0; frame < reference.frames(); frame += every) {
        reference.draw(frame);
        painter.draw(frame);
        for (std::size_t i = 0; i < sum.renderers.size(); ++i) {
            const RayRenderer::Difference& difference = judged.differences()[i];
            RayComparison::OfRenderer& own = sum.renderers[i];
            if (own.wrong == 0 && !difference.wrong.empty()) {
                own.first_wrong = text_of(difference.wrong.front(), frame);
            }
            own.differing += difference.differing;
            own.wrong += static_cast<long>(difference.wrong.size());
        }
        sum.pixels += static_cast<long>(settings.view.size_px.x) * settings.view.size_px.y;
        seen(++sum.frames, frames);
    }
    return sum;
}

} // namespace octant::ui::studies::draw_order
