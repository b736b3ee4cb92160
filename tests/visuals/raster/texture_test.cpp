#include "tests/visuals/raster/flat_plan.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace octant::visuals::raster {

namespace {

constexpr glm::ivec2 small_px{256, 192};
constexpr int texels = 512;
constexpr int levels_a_texel = 16;
constexpr float ground_per_m = 0.02F;

/// Up and down in steps of levels_a_texel.
int zigzag(int texel) {
    const int along = texel * levels_a_texel % 480;
    return along <= 240 ? along : 480 - along;
}

/// Red rises and falls from west to east, green from south to north.
scene::GroundTexture zigzag_texture() {
    scene::GroundTexture texture;
    texture.albedo = {.width = texels, .height = texels, .texels = {}};
    for (int row = 0; row < texels; ++row) {
        for (int column = 0; column < texels; ++column) {
            texture.albedo.texels.push_back(static_cast<std::uint8_t>(zigzag(column)));
            texture.albedo.texels.push_back(static_cast<std::uint8_t>(zigzag(row)));
            texture.albedo.texels.push_back(100);
        }
    }
    texture.normal = {.width = 2, .height = 2, .texels = std::vector<std::uint8_t>(8, 128)};
    return texture;
}

/// One over the distance of a slope that falls away from the lower left corner.
double inverse_depth(const glm::dvec2& at_px) {
    return 1.0 / 12.0 - 0.04 * at_px.x / small_px.x + 0.03 * at_px.y / small_px.y;
}

/// Light that leaves the texture's colours as they are.
void light_fully(FlatPlan& plan) {
    plan.plan().ambient = glm::vec3(1.0F);
    plan.plan().sunlight = glm::vec3(0.0F);
}

/// The level that the zigzag has at a place in texels, whose middles lie at whole numbers.
double level_at(double texel) {
    const int low = static_cast<int>(std::floor(texel));
    const double part = texel - low;
    return zigzag(low) * (1.0 - part) + zigzag(low + 1) * part;
}

/// One over the distance of ground that reaches to the picture's upper edge.
double inverse_depth_of_ground(double y_px) { return 0.01 + 0.09 * y_px / small_px.y; }

/// That ground in triangles of so many pixels: at the top a pixel is five times as long as wide.
void paint_ground(FlatPlan& plan, int cell_px, scene::DepthUse depth) {
    plan.paint(
        sheet(small_px, glm::ivec2(cell_px), [](const glm::dvec2& at_px) { return inverse_depth_of_ground(at_px.y); }),
        depth);
    light_fully(plan);
    const scene::TextureTransform place{glm::vec2(0.5F), glm::vec2(ground_per_m)};
    plan.plan().ground_texture = {place, place};
}

/// The mean red of the zigzag over a pixel of that ground, which does not change along a column.
double red_of_ground(int x, int y) {
    constexpr int side = 16;
    double sum = 0.0;
    for (int k = 0; k < side * side; ++k) {
        const glm::dvec2 at_px(x + (k % side + 0.5) / side, y + (k / side + 0.5) / side);
        const double across = at_px.x / small_px.x * 2.0 - 1.0;
        const double texel = (0.5 + across / inverse_depth_of_ground(at_px.y) * double{ground_per_m}) * texels - 0.5;
        sum += level_at(std::clamp(texel, 0.0, texels - 1.0));
    }
    return sum / (side * side);
}

} // namespace

TEST_CASE("ground at a slant keeps the contrast that its width has room for") {
    const scene::GroundTexture texture = zigzag_texture();
    for (const int cell_px : {8, 64}) {
        FlatPlan plan(small_px);
        paint_ground(plan, cell_px, scene::DepthUse::None);
        const scene::Picture picture = drawn(plan.plan(), small_px, 16, 1, &texture);
        // The zigzag's period is thirty texels; a pixel is three to six wide and up to thirty long.
        double errors = 0.0;
        double contrast = 0.0;
        for (int y = 8; y < 32; ++y) {
            for (int x = 96; x < 160; ++x) { // where the texture lies
                const double red = red_of_ground(x, y);
                errors += (pixel(picture, x, y).x - red) * (pixel(picture, x, y).x - red);
                contrast += (red - 120.0) * (red - 120.0);
            }
        }
        CAPTURE(cell_px, errors / contrast);
        CHECK(errors < 0.05 * contrast);
    }
}

TEST_CASE("a texture looks the same in painting order and by depth") {
    const scene::GroundTexture texture = zigzag_texture();
    for (const int cell_px : {8, 64}) {
        FlatPlan ordered(small_px);
        paint_ground(ordered, cell_px, scene::DepthUse::None);
        FlatPlan by_depth(small_px);
        paint_ground(by_depth, cell_px, scene::DepthUse::Nearest);
        const scene::Picture one = drawn(ordered.plan(), small_px, 16, 1, &texture);
        const scene::Picture other = drawn(by_depth.plan(), small_px, 16, 1, &texture);
        double differences = 0.0;
        double contrast = 0.0;
        for (int y = 8; y < 32; ++y) {
            for (int x = 96; x < 160; ++x) {
                const int red = pixel(one, x, y).x;
                differences += std::abs(red - pixel(other, x, y).x);
                contrast += std::abs(red - 120);
            }
        }
        CAPTURE(cell_px, differences / contrast);
        CHECK(differences < 0.03 * contrast);
    }
}

TEST_CASE("places in a texture are right to a sixteenth of a texel in triangles of any size") {
    const scene::GroundTexture texture = zigzag_texture();

    // Planes hold for the whole of small triangles, and for parts of large ones.
    for (const glm::ivec2& cell_px : {glm::ivec2(8, 6), glm::ivec2(64, 96)}) {
        FlatPlan plan(small_px);
        plan.paint(sheet(small_px, cell_px, inverse_depth));
        light_fully(plan);
        constexpr float per_m = 0.0078125F;
        const scene::TextureTransform place{glm::vec2(0.5F), glm::vec2(per_m)};
        plan.plan().ground_texture = {place, place};
        const scene::Picture picture = drawn(plan.plan(), small_px, 16, 1, &texture);
        double worst = 0.0;
        for (int y = 0; y < small_px.y; ++y) {
            for (int x = 0; x < small_px.x; ++x) {
                const glm::dvec2 at_px(x + 0.5, y + 0.5);
                const glm::dvec2 share = at_px / glm::dvec2(small_px) * 2.0 - 1.0;
                const glm::dvec2 at_m = glm::dvec2(share.x, -share.y) / inverse_depth(at_px);
                const glm::dvec2 texel = (0.5 + at_m * double{per_m}) * double{texels} - 0.5;
                const glm::ivec3 seen = pixel(picture, x, y);
                worst = std::max(worst, std::abs(seen.x - level_at(texel.x)));
                worst = std::max(worst, std::abs(seen.y - level_at(texel.y)));
            }
        }
        CAPTURE(cell_px.x, cell_px.y);
        CHECK(worst < levels_a_texel / 16.0 + 1.0);
    }
}

} // namespace octant::visuals::raster
