#include "tests/visuals/raster/flat_plan.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace octant::visuals::raster {

namespace {

constexpr glm::ivec2 edge_picture_px{256, 192};

/// Ground in two triangles, before it thin black blades of no cover.
void paint_blades(FlatPlan& plan, std::uint32_t ground, bool has_blades) {
    const float right = edge_picture_px.x;
    const float bottom = edge_picture_px.y;
    FlatTriangle first;
    first.at_px = {glm::vec2(0.0F), glm::vec2(right, 0.0F), glm::vec2(0.0F, bottom)};
    FlatTriangle second;
    second.at_px = {glm::vec2(right, 0.0F), glm::vec2(right, bottom), glm::vec2(0.0F, bottom)};
    first.colour.fill(ground);
    second.colour.fill(ground);
    plan.paint({first, second});
    std::vector<FlatTriangle> blades;
    for (int i = 0; i < 9 && has_blades; ++i) {
        FlatTriangle blade;
        const auto y = static_cast<float>(15 + 20 * i);
        blade.at_px = {glm::vec2(10.0F, y), glm::vec2(240.0F, y + static_cast<float>(i)),
            glm::vec2(240.0F, y + 2.5F + static_cast<float>(i))};
        blade.colour.fill(0U);
        blades.push_back(blade);
    }
    plan.paint(blades);
}

scene::Picture blades_drawn(std::uint32_t ground, bool has_blades, bool has_detail_texture) {
    FlatPlan plan(edge_picture_px);
    paint_blades(plan, ground, has_blades);
    if (has_detail_texture) { plan.plan().detail_texture = strong_detail(); }
    return drawn(plan.plan(), edge_picture_px, 16);
}

} // namespace

TEST_CASE("where something covers a part of a pixel its ground keeps the colour of its cover") {
    constexpr std::uint32_t covered = 0x60808080U;
    const scene::Picture ground = blades_drawn(covered, false, true);
    const scene::Picture blades = blades_drawn(covered, true, true);
    const scene::Picture left = blades_drawn(0x00ffffffU, true, false);
    int edges = 0;
    int wrong = 0;
    for (int y = 0; y < edge_picture_px.y; ++y) {
        for (int x = 0; x < edge_picture_px.x; ++x) {
            const double share = pixel(left, x, y).x / 255.0;
            const double own = pixel(ground, x, y).x;
            edges += share > 0.0 && share < 1.0 ? 1 : 0;
            const double seen = pixel(blades, x, y).x;
            // The mean of ground and blade changes, not the ground's part alone; where the ground beside is hidden, it
            // may be left as it is.
            const double changed = std::abs(seen - share * own);
            const double unchanged = std::abs(seen - share * 128.0);
            wrong += std::min(changed, unchanged) > 0.3 * own + 3.0 ? 1 : 0;
        }
    }
    CHECK(edges > 1000);
    CHECK(wrong < 20);
}

} // namespace octant::visuals::raster
