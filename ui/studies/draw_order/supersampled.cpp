#include "ui/studies/draw_order/supersampled.h"

#include <cstddef>

namespace octant::ui::studies::draw_order {

namespace scene = visuals::scene;

scene::FramePlan
shifted_plan(const scene::FramePlan& plan, const glm::dvec2& by_px, const glm::ivec2& size_px) {
    scene::FramePlan result = plan;
    const glm::vec2 by(2.0 * by_px / glm::dvec2(size_px));
    for (glm::length_t column = 0; column < 4; ++column) {
        glm::vec4& clip = result.view_to_clip[column];
        clip.x += by.x * clip.w;
        clip.y -= by.y * clip.w;
    }
    std::erase_if(result.steps, [](const scene::PaintStep& step) {
        return step.content == scene::PaintStep::Content::Overlay;
    });
    return result;
}

namespace {

/// A copy of a plan that shows one of side x side equal parts of its picture, as large as the
/// whole.
scene::FramePlan part_of(const scene::FramePlan& plan, const glm::ivec2& part, int side) {
    scene::FramePlan result = plan;
    const glm::vec2 across = (2.0F * glm::vec2(part) + 1.0F) / static_cast<float>(side);
    const glm::vec2 middle(across.x - 1.0F, 1.0F - across.y);
    for (glm::length_t column = 0; column < 4; ++column) {
        glm::vec4& clip = result.view_to_clip[column];
        clip.x = static_cast<float>(side) * (clip.x - middle.x * clip.w);
        clip.y = static_cast<float>(side) * (clip.y - middle.y * clip.w);
    }
    return result;
}

} // namespace

void Supersampled::draw(
    scene::Renderer& renderer,
    const scene::FramePlan& plan,
    const glm::dvec2& by_px,
    const glm::ivec2& size_px) {
    const auto width = static_cast<std::size_t>(size_px.x);
    const auto height = static_cast<std::size_t>(size_px.y);
    sums_.assign(3 * width * height, 0);
    const scene::FramePlan whole = shifted_plan(plan, by_px, size_px);
    for (int part = 0; part < samples_per_pixel; ++part) {
        const glm::ivec2 at(part % side, part / side);
        renderer.draw(part_of(whole, at, side));
        renderer.finish_and_read(picture_);
        const auto first_column = static_cast<std::size_t>(at.x) * width;
        const auto first_row = static_cast<std::size_t>(at.y) * height;
        for (std::size_t i = 0; i < width * height; ++i) {
            const std::size_t column = (first_column + i % width) / side;
            const std::size_t row = (first_row + i / width) / side;
            std::uint16_t* const sum = sums_.data() + 3 * (row * width + column);
            for (std::size_t k = 0; k < 3; ++k) {
                sum[k] = static_cast<std::uint16_t>(sum[k] + picture_.rgba[4 * i + k]);
            }
        }
    }
}

} // namespace octant::ui::studies::draw_order
