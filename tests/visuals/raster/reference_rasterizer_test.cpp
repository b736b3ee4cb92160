#include "tests/visuals/raster/flat_plan.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <memory>

namespace octant::visuals::raster {

namespace {

constexpr glm::ivec2 size_px{200, 150};
constexpr std::uint32_t black = 0xff000000U;

/// Triangles of one depth each that lie over each other in any order.
std::vector<FlatTriangle> many_triangles(std::uint64_t seed) {
    RandomGenerator dice(seed);
    std::vector<FlatTriangle> triangles;
    for (int i = 0; i < 400; ++i) {
        FlatTriangle triangle;
        const float across_px = static_cast<float>(below(dice, 20000)) / 100.0F;
        const float down_px = static_cast<float>(below(dice, 15000)) / 100.0F;
        const glm::vec2 middle(across_px, down_px);
        triangle.depth_m.fill(2.0F + static_cast<float>(below(dice, 1000)) / 10.0F);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto part = [&] { return static_cast<float>(below(dice, 6001)) / 100.0F - 30.0F; };
            const float x = part();
            triangle.at_px[k] = middle + glm::vec2(x, part());
            triangle.colour[k] = static_cast<std::uint32_t>(below(dice, 1U << 24)) | black;
        }
        triangles.push_back(triangle);
    }
    return triangles;
}

void clear_depth(FlatPlan& plan) {
    plan.plan().depth_boxes.push_back({glm::ivec2(0), size_px});
    plan.plan().steps.push_back(
        {scene::PaintStep::Content::ClearDepth, static_cast<std::uint32_t>(plan.plan().depth_boxes.size() - 1), 1});
}

/// Everything by one depth buffer.
void paint_by_depth(FlatPlan& plan) {
    clear_depth(plan);
    plan.paint(many_triangles(3), scene::DepthUse::Nearest);
}

void paint_black(FlatPlan& plan) {
    FlatTriangle black_one;
    black_one.at_px = {glm::vec2(-10.0F), glm::vec2(500.0F, -10.0F), glm::vec2(-10.0F, 500.0F)};
    black_one.colour.fill(black);
    plan.paint({black_one});
}

int largest_difference(const scene::Picture& a, const scene::Picture& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
        largest = std::max(largest, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
    }
    return largest;
}

} // namespace

TEST_CASE("from far to near, each over what is there, the picture is the same") {
    FlatPlan plan(size_px);
    plan.paint(many_triangles(1));
    clear_depth(plan);
    plan.paint(many_triangles(2), scene::DepthUse::Nearest);
    plan.paint(many_triangles(4));
    for (const bool has_detail_texture : {false, true}) {
        if (has_detail_texture) { plan.plan().detail_texture = strong_detail(); }
        const scene::Picture near_to_far = drawn(plan.plan(), size_px, 1);
        Renderer renderer(std::make_shared<ThreadPool>(2), size_px, 1);
        renderer.set_paint_direction(Renderer::PaintDirection::FarToNear);
        scene::Picture far_to_near;
        renderer.draw(plan.plan());
        renderer.finish_and_read(far_to_near);
        CHECK(largest_difference(near_to_far, far_to_near) <= 1);
    }
}

TEST_CASE("a picture all by depth is the same alone and before something else") {
    FlatPlan alone(size_px);
    paint_by_depth(alone);
    FlatPlan before_black(size_px);
    paint_black(before_black);
    paint_by_depth(before_black);
    const scene::Picture picture = drawn(alone.plan(), size_px, 1);
    CHECK(largest_difference(picture, drawn(before_black.plan(), size_px, 1)) <= 1);
    FlatPlan in_order(size_px);
    in_order.paint(many_triangles(3));
    CHECK(largest_difference(picture, drawn(in_order.plan(), size_px, 1)) > 30);
}

} // namespace octant::visuals::raster
