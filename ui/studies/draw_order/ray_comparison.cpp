#include "ui/studies/draw_order/ray_comparison.h"

#include "ui/flight/id_comparison.h"
#include "ui/flight/session.h"
#include "ui/studies/draw_order/ray_renderer.h"

#include <fmt/format.h>
#include <memory>
#include <optional>
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

/// Frames of a run as they are painted, in order, but without rounding. They are drawn when they
/// are asked for.
class Unrounded {
public:
    /// `beside` stays where it is.
    Unrounded(const settings::RunSettings& painted, const ui::world::World& beside)
        : painted_(painted)
        , beside_(beside) {}

    const RayRenderer& at(int frame) {
        if (!session_) {
            auto renderer = std::make_unique<RayRenderer>(painted_.view.size_px);
            renderer_ = renderer.get();
            session_.emplace(painted_, Shows::PolygonNumbers, std::move(renderer), &beside_);
        }
        if (frame_ != frame) {
            session_->draw(frame);
            frame_ = frame;
        }
        return *renderer_;
    }

private:
    settings::RunSettings painted_;
    const ui::world::World& beside_;
    std::optional<Session> session_;
    const RayRenderer* renderer_ = nullptr; ///< of the session
    int frame_ = -1;
};

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
    int every,
    const std::function<void(int compared, int frames)>& seen) {
    auto [painted, by_depth] = flight::compared_settings(settings);
    auto renderer = std::make_unique<RayRenderer>(painted.view.size_px);
    const RayRenderer& rays = *renderer;
    Session reference(by_depth, Shows::PolygonNumbers, std::move(renderer));
    std::array<std::unique_ptr<Session>, rayed_renderers.size()> painters;
    for (std::size_t i = 0; i < painters.size(); ++i) {
        painted.drawing.renderer = rayed_renderers[i];
        painters[i] =
            std::make_unique<Session>(painted, Shows::PolygonNumbers, nullptr, &reference.world());
    }
    Unrounded unrounded(painted, reference.world());
    RayComparison sum;
    const int frames = (reference.frames() + every - 1) / every;
    for (int frame = 0; frame < reference.frames(); frame += every) {
        reference.draw(frame);
        for (std::size_t i = 0; i < painters.size(); ++i) {
            painters[i]->draw(frame);
            const visuals::scene::Picture& picture = painters[i]->picture();
            auto difference = rays.compare(picture, rounding_reach_px);
            std::erase_if(difference.wrong, [&](const RayRenderer::WrongPixel& pixel) {
                return unrounded.at(frame).is_rounding(
                    pixel.at, pixel.number, rays.number_of(pixel.at), rounding_reach_px);
            });
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
