#include "tests/visuals/raster/flat_plan.h"
#include "visuals/scene/picture.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::raster {

namespace {

constexpr glm::ivec2 window_px{150, 70};
constexpr scene::PixelRect corner{90, 30, 50, 30};

/// A window that keeps what it is shown.
class KeptPicture final : public scene::WindowPicture {
public:
    std::uint8_t* begin(const glm::ivec2& px) override {
        pixels.assign(4 * static_cast<std::size_t>(px.x * px.y), 0);
        return pixels.data();
    }

    void show(const glm::ivec2& px) override { shown_px = px; }

    std::vector<std::uint8_t> pixels;
    glm::ivec2 shown_px{0};
};

std::vector<std::uint8_t> with_red_and_blue_swapped(const scene::Picture& picture) {
    std::vector<std::uint8_t> swapped(picture.rgba.begin(), picture.rgba.end());
    for (std::size_t at = 0; at < swapped.size(); at += 4) { std::swap(swapped[at], swapped[at + 2]); }
    return swapped;
}

void paint_some(FlatPlan& plan) {
    FlatTriangle triangle;
    triangle.at_px = {glm::vec2(-3.0F, 4.0F), {140.5F, 11.25F}, {60.0F, 80.0F}};
    triangle.colour = {0xff2080f0U, 0xff00ff10U, 0xffff4000U};
    plan.paint({triangle});
    plan.plan().background = glm::vec3(0.9F, 0.5F, 0.1F);
}

void add_pane(scene::FramePlan& plan) {
    plan.ambient = glm::vec3(1.0F);
    plan.smooth = {~0U};
    plan.parts = {glm::mat4(1.0F)};
    plan.aircraft = {{.model = 0, .first_index = 0, .index_count = 6}};
    plan.depth_boxes = {{glm::ivec2(0), window_px}};
    using scene::PaintStep;
    plan.steps.push_back({PaintStep::Content::ClearDepth, 0, 1});
    plan.steps.push_back({PaintStep::Content::Aircraft, 0, 1, PaintStep::no_clip, scene::DepthUse::Nearest, 0.25F});
}

} // namespace

TEST_CASE("a picture in a window's memory is the one that is read, blue first") {
    FlatPlan plan(window_px);
    paint_some(plan);
    FlatPlan second(glm::ivec2(corner.width, corner.height));
    paint_some(second);
    const std::vector<scene::OverlayVertex> words{{.at_px = {5.0F, 5.0F}, .colour = 0x80ff3000U},
        {.at_px = {70.0F, 9.0F}, .colour = 0x80ff3000U}, {.at_px = {9.0F, 60.0F}, .colour = 0x80ff3000U}};
    const std::vector<std::uint32_t> indices{0, 1, 2};
    plan.plan().overlay = {words, indices};
    const auto window = std::make_shared<KeptPicture>();
    Renderer renderer(std::make_shared<ThreadPool>(1), window_px, 16, window);
    scene::ModelBuffers model;
    add_square(model, 1.0F, -4.0F, 0xff0080ffU); // orange, drawn a quarter opaque
    renderer.load_models(std::span(&model, 1));
    const auto draw = [&] {
        renderer.draw(plan.plan());
        renderer.draw_inset(second.plan(), corner);
    };
    scene::Picture without_pane;
    draw();
    renderer.finish_and_read(without_pane);
    add_pane(plan.plan());
    scene::Picture read;
    draw();
    CHECK_FALSE(renderer.is_drawn_to_window());
    renderer.finish_and_read(read);
    CHECK(read.rgba != without_pane.rgba);

    renderer.set_window_target(window_px);
    draw();
    CHECK(renderer.is_drawn_to_window());
    CHECK(window->pixels == with_red_and_blue_swapped(read));
    renderer.copy_to_window(glm::ivec2(300, 140));
    CHECK(window->shown_px == glm::ivec2(300, 140));

    scene::Picture again;
    renderer.set_window_target(glm::ivec2(0));
    draw();
    renderer.finish_and_read(again);
    CHECK(again.rgba == read.rgba);
}

} // namespace octant::visuals::raster
