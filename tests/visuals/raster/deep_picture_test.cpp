#include "sim/base/thread_pool.h"
#include "visuals/raster/renderer.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <set>
#include <vector>

#include "flat_plan.h"

namespace octant::visuals::raster {

namespace {

struct DeepPicture {
    scene::Picture picture;
    std::vector<std::uint16_t> deep;
};

DeepPicture deep_drawn(const scene::FramePlan& plan, const glm::ivec2& size_px, int threads) {
    Renderer renderer(std::make_shared<ThreadPool>(threads), size_px, 16);
    DeepPicture drawn;
    drawn.deep.resize(static_cast<std::size_t>(size_px.x * size_px.y) * 3);
    renderer.draw_deep(plan, drawn.deep);
    renderer.finish_and_read(drawn.picture);
    return drawn;
}

} // namespace

TEST_CASE("a picture with 16 bits agrees with that of 8 bits and has levels between its levels") {
    const glm::ivec2 size_px(150, 70);
    FlatPlan plan(size_px);
    FlatTriangle ramp;
    ramp.at_px = {glm::vec2(0, 0), glm::vec2(300, 0), glm::vec2(0, 140)};
    ramp.colour = {0xff202020U, 0xff282420U, 0xff202428U}; // eight levels over 300 pixels
    plan.paint({ramp});
    std::vector<scene::OverlayVertex> vertices;
    const std::vector<std::uint32_t> indices{0, 1, 2};
    for (const glm::vec2 at : {glm::vec2(80.3F, 5.2F), {140.1F, 20.7F}, {95.5F, 66.1F}}) {
        vertices.push_back({at, 0x60f0a010U});
    }
    plan.plan().overlay = {vertices, indices};
    plan.plan().steps.push_back({scene::PaintStep::Content::Transparent, 0, 3});
    const DeepPicture drawn = deep_drawn(plan.plan(), size_px, 1);
    int worst = 0;
    std::set<std::uint16_t> levels;
    for (std::size_t i = 0; i < drawn.deep.size(); ++i) {
        const int byte = drawn.picture.rgba[i / 3 * 4 + i % 3];
        worst = std::max(worst, std::abs(drawn.deep[i] - byte * 257));
        levels.insert(drawn.deep[i]);
    }
    CHECK(worst <= 257); // half a level by rounding, once more by blending
    CHECK(levels.size() > 100);
    CHECK(deep_drawn(plan.plan(), size_px, 3).deep == drawn.deep);
}

TEST_CASE("a pixel that is covered in part has the mean of its samples with 16 bits") {
    const glm::ivec2 size_px(8, 8);
    FlatPlan plan(size_px);
    FlatTriangle left;
    left.at_px = {glm::vec2(-10, -50), glm::vec2(3.5F, -50), glm::vec2(3.5F, 100)};
    FlatTriangle rest = left;
    rest.at_px = {glm::vec2(-10, -50), glm::vec2(3.5F, 100), glm::vec2(-10, 100)};
    plan.paint({left, rest});
    const DeepPicture drawn = deep_drawn(plan.plan(), size_px, 1);
    const auto red = [&](std::size_t column) { return drawn.deep[3 * (8 * 4 + column)]; };
    CHECK(red(2) == 65535);
    CHECK(red(3) == 32768);
    CHECK(red(4) == 0);
}

} // namespace octant::visuals::raster
