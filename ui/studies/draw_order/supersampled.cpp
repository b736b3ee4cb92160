#include "ui/studies/draw_order/supersampled.h"

#include <cstddef>

namespace octant::ui::studies::draw_order {

namespace scene = visuals::scene;

scene::FramePlan
moved(const scene::FramePlan& plan, const glm::dvec2& by_px, const glm::ivec2& size_px) {
    scene::FramePlan result = plan;
    const glm::vec2 by(2.0 * by_px / glm::dvec2(size_px));
    for (glm::length_t column = 0; column < 4; ++column) {
        glm::vec4& clip = result.view_to_clip[column];
        clip.x += by.x * clip.w;
        clip.y -= by.y * clip.w;
    }
    std::erase_if(result.steps, [](const scene::PaintStep& step) {
        return step.what == scene::PaintStep::What::Overlay;
    });
    return result;
}

void Supersampled::draw(
    scene::Renderer& renderer,
    const scene::FramePlan& plan,
    const glm::dvec2& by_px,
    const glm::ivec2& size_px) {
    sums_.assign(
        std::size_t{3} * static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y),
        0);
    for (int place = 0; place < places; ++place) {
        const glm::dvec2 within = (glm::dvec2(place % side, place / side) + 0.5) / double{side};
        renderer.draw(moved(plan, by_px + 0.5 - within, size_px));
        renderer.finish_and_read(picture_);
        for (std::size_t pixel = 0; pixel < sums_.size() / 3; ++pixel) {
            for (std::size_t part = 0; part < 3; ++part) {
                sums_[3 * pixel + part] = static_cast<std::uint16_t>(
                    sums_[3 * pixel + part] + picture_.rgba[4 * pixel + part]);
            }
        }
    }
}

} // namespace octant::ui::studies::draw_order
