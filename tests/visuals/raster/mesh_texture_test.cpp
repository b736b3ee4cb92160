#include "sim/base/random_generator.h"
#include "tests/visuals/raster/flat_plan.h"
#include "visuals/raster/renderer.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace octant::visuals::raster {

namespace {

using models::SurfaceTexture;
using models::TextureAlpha;
using models::TextureWrap;
using scene::DepthUse;
using scene::PaintStep;
using Texel = std::function<glm::ivec4(int, int)>; ///< of a column and a row from the top, 0..255

SurfaceTexture texture_of(int width, int height, const Texel& texel) {
    models::TextureLevel level{width, height, {}};
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const glm::ivec4 of = texel(column, row);
            for (const int value : {of.x, of.y, of.z, of.w}) { level.rgba.push_back(static_cast<std::uint8_t>(value)); }
        }
    }
    return {std::make_shared<const models::TexturePicture>(models::texture_picture("test", level)), TextureWrap::Clamp,
        TextureWrap::Clamp, TextureAlpha::Opaque, 0.5F};
}

SurfaceTexture uniform(const glm::ivec4& texel) {
    return texture_of(2, 2, [&](int, int) { return texel; });
}

/// Polygons of one model in a light that leaves colours as they are, before black.
struct TexturedModel {
    scene::ModelBuffers model;
    FlatPlan flat;
    glm::ivec2 size_px;

    explicit TexturedModel(const glm::ivec2& picture_px) : flat(picture_px), size_px(picture_px) {
        plan().ambient = glm::vec3(1.0F);
        plan().sunlight = glm::vec3(0.0F);
        plan().parts = {glm::mat4(1.0F)};
        plan().smooth = {0U};
    }

    scene::FramePlan& plan() { return flat.plan(); }

    /// A quadrilateral with corners from the lower left one on, and their places in the last texture.
    void add(const std::array<glm::vec3, 4>& corners_m, const std::array<glm::vec2, 4>& on_texture) {
        const auto first = static_cast<std::uint32_t>(model.vertices.size());
        add_square(model, 1.0F, 0.0F, 0xffffffffU);
        const glm::vec3 normal = glm::normalize(glm::cross(corners_m[1] - corners_m[0], corners_m[3] - corners_m[0]));
        for (std::size_t i = 0; i < 4; ++i) {
            scene::ModelVertex& vertex = model.vertices[first + i];
            vertex.position_m = corners_m[i];
            vertex.normal = vertex.face_normal = normal;
            vertex.on_texture = on_texture[i];
            vertex.texture = static_cast<std::uint32_t>(model.textures.size());
        }
    }

    /// A square that faces the eye: all of its texture, from `from` to `to`.
    void add_facing(
        float half_m, float depth_m, const glm::vec2& from = glm::vec2(0.0F), const glm::vec2& to = glm::vec2(1.0F)) {
        add({glm::vec3(-half_m, -half_m, -depth_m), glm::vec3(half_m, -half_m, -depth_m),
                glm::vec3(half_m, half_m, -depth_m), glm::vec3(-half_m, half_m, -depth_m)},
            {glm::vec2(from.x, to.y), to, glm::vec2(to.x, from.y), from});
    }

    scene::Picture picture(int samples, DepthUse depth = DepthUse::None, float opacity = 1.0F) {
        scene::FramePlan& all = plan();
        all.aircraft = {{.index_count = static_cast<std::uint32_t>(model.indices.size())}};
        all.depth_boxes = {{glm::ivec2(0), size_px}};
        all.steps = {{PaintStep::Content::ClearDepth, 0, 1},
            {PaintStep::Content::Aircraft, 0, 1, PaintStep::no_clip, depth, opacity}};
        return drawn(all, size_px, samples, 1, nullptr, std::span(&model, 1));
    }
};

int worst_channel(const glm::ivec3& a, const glm::ivec3& b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

constexpr glm::ivec3 no_light(0);
constexpr glm::ivec3 full_light(255);

/// Peak signal to noise ratio, dB, against means of blocks of a picture that is `factor` times as large.
double psnr_db(const scene::Picture& picture, const scene::Picture& large, int factor) {
    double squares = 0.0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            glm::dvec3 sum(0.0);
            for (int i = 0; i < factor * factor; ++i) {
                sum += glm::dvec3(pixel(large, x * factor + i % factor, y * factor + i / factor));
            }
            const glm::dvec3 wrong = glm::dvec3(pixel(picture, x, y)) - sum / static_cast<double>(factor * factor);
            squares += glm::dot(wrong, wrong);
        }
    }
    const double mean = squares / (3.0 * picture.width * picture.height);
    return 10.0 * std::log10(255.0 * 255.0 / mean);
}

/// Panels, lines between them, a stripe and a roundel.
glm::ivec4 livery(int column, int row) {
    const glm::vec2 from_roundel(column - 90, row - 130);
    const float radius = glm::length(from_roundel);
    if (radius < 12.0F) { return {190, 30, 40, 255}; }
    if (radius < 30.0F) { return {240, 240, 235, 255}; }
    if (radius < 44.0F) { return {30, 40, 120, 255}; }
    if (row > 60 && row < 80) { return {220, 160, 40, 255}; }
    if (column % 32 == 0 || row % 32 == 0) { return {90, 95, 100, 255}; }
    const int panel = (column / 32 * 7 + row / 32 * 5) % 6;
    return {130 + 6 * panel, 138 + 5 * panel, 145 + 4 * panel, 255};
}

/// A wall from 4 to 40 m, whose texture lies evenly on it.
void add_wall(TexturedModel& scene) {
    scene.add({glm::vec3(-3.6F, -3.6F, -4.0F), glm::vec3(36.0F, -36.0F, -40.0F), glm::vec3(36.0F, 36.0F, -40.0F),
                  glm::vec3(-3.6F, 3.6F, -4.0F)},
        {glm::vec2(0.0F, 0.55F), glm::vec2(1.0F, 1.0F), glm::vec2(1.0F, 0.0F), glm::vec2(0.0F, 0.45F)});
}

} // namespace

TEST_CASE("a texture lies upright between the places of its corners") {
    constexpr int texel_px = 15;
    TexturedModel scene(glm::ivec2(4 * texel_px));
    const Texel colours = [](int column, int row) { return glm::ivec4(80 * column, 80 * row, 200, 255); };
    scene.model.textures.push_back(texture_of(4, 4, colours));
    scene.add_facing(10.0F, 10.0F);
    const int samples = GENERATE(1, 4, 16);
    const DepthUse depth = GENERATE(DepthUse::None, DepthUse::Nearest);
    const scene::Picture picture = scene.picture(samples, depth);
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            const glm::ivec3 seen = pixel(picture, column * texel_px + texel_px / 2, row * texel_px + texel_px / 2);
            CAPTURE(samples, column, row, seen.x, seen.y, seen.z);
            CHECK(worst_channel(seen, glm::ivec3(colours(column, row))) <= 1);
        }
    }
    // Halfway between two texels: their mean.
    CHECK(pixel(picture, texel_px, texel_px / 2).x == Approx(40).margin(4));
}

TEST_CASE("beyond its edges a texture repeats, stops or is mirrored") {
    constexpr int texel_px = 11;
    constexpr int cells = 6; // three pictures of two texels
    const auto [wrap, expected] =
        GENERATE(table<TextureWrap, std::array<int, cells>>({{TextureWrap::Repeat, {0, 1, 0, 1, 0, 1}},
            {TextureWrap::Clamp, {0, 0, 0, 1, 1, 1}}, {TextureWrap::Mirror, {1, 0, 0, 1, 1, 0}}}));
    const float further = GENERATE(0.0F, 2.0F, -10.0F, 1000.0F); // whole pairs of pictures
    if (wrap == TextureWrap::Clamp && further != 0.0F) { return; }
    const bool is_down = GENERATE(false, true);
    TexturedModel scene(glm::ivec2(cells * texel_px));
    SurfaceTexture texture = texture_of(2, 2, [&](int column, int row) {
        const int value = (is_down ? row : column) * 255;
        return glm::ivec4(value, value, value, 255);
    });
    texture.wrap_u = texture.wrap_v = wrap;
    scene.model.textures.push_back(texture);
    scene.add_facing(10.0F, 10.0F, glm::vec2(further - 1.0F), glm::vec2(further + 2.0F));
    const scene::Picture picture = scene.picture(16);
    for (int cell = 0; cell < cells; ++cell) {
        const int at = cell * texel_px + texel_px / 2;
        CAPTURE(wrap, further, is_down, cell);
        CHECK(pixel(picture, is_down ? 5 : at, is_down ? at : 5).x ==
              Approx(255 * expected[static_cast<std::size_t>(cell)]).margin(2));
    }
}

TEST_CASE("places in a texture are those of perspective") {
    constexpr int width_px = 80;
    TexturedModel scene(glm::ivec2(width_px, width_px));
    scene.model.textures.push_back(
        texture_of(64, 64, [](int column, int row) { return glm::ivec4(4 * column, 4 * row, 0, 255); }));
    add_wall(scene);
    const scene::Picture picture = scene.picture(GENERATE(1, 16));
    for (int y = 20; y < 60; y += 3) {
        for (int x = 6; x < 74; ++x) {
            // Where the ray meets the wall: x = depth * across = 1.1 * (depth - 4) - 3.6.
            const double across = (x + 0.5) / width_px * 2.0 - 1.0;
            const double down = (y + 0.5) / width_px * 2.0 - 1.0;
            const double depth = 8.0 / (1.1 - across);
            const double u = (depth - 4.0) / 36.0;
            const double v = 0.5 + down * depth / 72.0;
            const glm::ivec3 seen = pixel(picture, x, y);
            CAPTURE(x, y, u, v);
            CHECK(seen.x == Approx(256.0 * u - 2.0).margin(3.0));
            CHECK(seen.y == Approx(256.0 * v - 2.0).margin(3.0));
        }
    }
}

TEST_CASE("textured surfaces, near and far, are within 36 dB of eight by eight samples a pixel") {
    constexpr int factor = 8;
    constexpr glm::ivec2 psnr_size_px{96, 96};
    const auto fill = [](TexturedModel& scene) {
        SurfaceTexture texture = texture_of(256, 256, livery);
        texture.wrap_u = texture.wrap_v = TextureWrap::Repeat;
        scene.model.textures.push_back(texture);
        add_wall(scene);
        scene.add({glm::vec3(-9.0F, -8.0F, -10.0F), glm::vec3(-2.0F, -9.0F, -14.0F), glm::vec3(-2.0F, -5.0F, -14.0F),
                      glm::vec3(-9.0F, -5.0F, -10.0F)},
            {glm::vec2(0.0F, 1.0F), glm::vec2(1.0F, 1.0F), glm::vec2(1.0F, 0.0F), glm::vec2(0.0F, 0.0F)});
        scene.add({glm::vec3(-9.0F, 5.0F, -10.0F), glm::vec3(1.0F, 6.0F, -10.5F), glm::vec3(2.0F, 9.0F, -10.0F),
                      glm::vec3(-8.0F, 8.5F, -10.0F)},
            {glm::vec2(0.0F, 1.0F), glm::vec2(1.0F, 1.0F), glm::vec2(1.0F, 0.0F), glm::vec2(0.0F, 0.0F)});
    };
    TexturedModel scene(psnr_size_px);
    fill(scene);
    TexturedModel large(psnr_size_px * factor);
    fill(large);
    const double db = psnr_db(scene.picture(16), large.picture(1), factor);
    CAPTURE(db);
    CHECK(db >= 36.0);
}

TEST_CASE("painting order equals depth in three hundred pictures of textured squares, some with holes") {
    constexpr glm::ivec2 order_size_px{48, 40};
    RandomGenerator dice(22);
    const auto random = [&](double from, double to) { return static_cast<float>(from + dice.next() * (to - from)); };
    std::vector<SurfaceTexture> textures;
    for (int i = 0; i < 4; ++i) {
        textures.push_back(texture_of(9 + 5 * i, 16, [&](int, int) {
            const auto value = [&] { return static_cast<int>(below(dice, 256)); };
            const int red = value();
            const int green = value();
            return glm::ivec4(red, green, 128, i % 2 == 0 ? value() : 255);
        }));
        textures.back().alpha = i % 2 == 0 ? TextureAlpha::Mask : TextureAlpha::Opaque;
        textures.back().wrap_u = static_cast<TextureWrap>(i % 3);
        textures.back().wrap_v = static_cast<TextureWrap>(i / 2);
    }
    int different = 0;
    for (int i = 0; i < 300; ++i) {
        TexturedModel scene(order_size_px);
        for (int k = 0; k < 7; ++k) {
            scene.model.textures.push_back(textures[below(dice, textures.size())]);
            const float depth_m = 40.0F - 5.0F * static_cast<float>(k); // from far to near
            const glm::vec2 middle(random(-0.8, 0.8), random(-0.8, 0.8));
            const float turn = random(0.0, 6.28);
            const float reach = random(0.1, 0.9);
            std::array<glm::vec3, 4> corners;
            for (std::size_t c = 0; c < 4; ++c) {
                const float angle = turn + 1.5708F * static_cast<float>(c);
                corners[c] =
                    glm::vec3((middle + reach * glm::vec2(std::cos(angle), std::sin(angle))) * depth_m, -depth_m);
            }
            const glm::vec2 last(random(0.5, 4.0), random(0.5, 4.0));
            scene.add(corners, {glm::vec2(0.0F, last.y), last, glm::vec2(last.x, 0.0F), glm::vec2(0.0F)});
        }
        const int samples = std::array{1, 4, 16}[static_cast<std::size_t>(i % 3)];
        different += scene.picture(samples).rgba != scene.picture(samples, DepthUse::Nearest).rgba ? 1 : 0;
    }
    CHECK(different == 0);
}

TEST_CASE("there is nothing in a hole of a texture, for the truth neither") {
    constexpr glm::ivec2 hole_size_px{60, 60};
    TexturedModel scene(hole_size_px);
    scene.model.textures.push_back(uniform({0, 0, 255, 255}));
    scene.add_facing(20.0F, 20.0F);
    SurfaceTexture texture =
        texture_of(4, 4, [](int column, int row) { return glm::ivec4(255, 0, 0, column == 1 && row == 2 ? 0 : 255); });
    texture.alpha = TextureAlpha::Mask;
    scene.model.textures.push_back(texture);
    scene.add_facing(10.0F, 10.0F);
    const int samples = GENERATE(1, 16);
    const scene::Picture picture = scene.picture(samples, GENERATE(DepthUse::None, DepthUse::Nearest));
    CHECK(worst_channel(pixel(picture, 22, 37), {0, 0, 255}) <= 1);
    CHECK(worst_channel(pixel(picture, 7, 7), {255, 0, 0}) <= 1);
    Renderer renderer(std::make_shared<ThreadPool>(1), hole_size_px, samples);
    renderer.load_models(std::span(&scene.model, 1));
    renderer.prepare_truth(scene.plan());
    std::vector<float> depth_m(60 * 60);
    std::vector<float> coverage(60 * 60);
    scene::TruthArrays truth;
    truth.depth_m = depth_m.data();
    truth.coverage = coverage.data();
    renderer.draw_truth(scene.plan(), truth);
    CHECK(depth_m[37 * 60 + 22] == Approx(20.0F));
    CHECK(depth_m[7 * 60 + 7] == Approx(10.0F));
    for (const float share : coverage) { CHECK(share == 1.0F); } // one object
}

TEST_CASE("the alpha of a texture makes glass more transparent, and counts nowhere else") {
    TexturedModel scene(glm::ivec2(20, 20));
    const TextureAlpha alpha = GENERATE(TextureAlpha::Blend, TextureAlpha::Opaque);
    scene.model.textures.push_back(uniform({255, 255, 255, 128}));
    scene.model.textures.back().alpha = alpha;
    scene.add_facing(10.0F, 10.0F);
    const int samples = GENERATE(1, 4, 16);
    const int expected = alpha == TextureAlpha::Blend ? 64 : 128;
    CHECK(pixel(scene.picture(samples, DepthUse::Nearest, 0.5F), 9, 9).x == Approx(expected).margin(2));
    CHECK(pixel(scene.picture(samples, DepthUse::Nearest), 9, 9).x == Approx(255).margin(1));
    CHECK(pixel(scene.picture(samples), 9, 9).x == Approx(255).margin(1));
}

TEST_CASE("light and haze fall on a texture as on a colour") {
    const std::uint32_t smooth = GENERATE(0U, 1U);
    const bool lights_pixels = GENERATE(false, true);
    const float visibility_m = GENERATE(0.0F, 15.0F);
    const auto lit = [&](TexturedModel& scene) {
        scene.plan().smooth = {smooth};
        scene.plan().lights_pixels = lights_pixels;
        scene.plan().ambient = glm::vec3(0.3F, 0.4F, 0.5F);
        scene.plan().sunlight = glm::vec3(0.45F);
        scene.plan().to_sun = glm::normalize(glm::vec3(0.3F, 0.2F, 0.8F));
        scene.plan().haze = {.colour = glm::vec3(0.6F, 0.7F, 0.8F), .visibility_m = visibility_m};
        scene.add({glm::vec3(-8.0F, -8.0F, -8.0F), glm::vec3(9.0F, -9.0F, -12.0F), glm::vec3(9.0F, 9.0F, -12.0F),
                      glm::vec3(-8.0F, 8.0F, -8.0F)},
            {});
        scene.model.vertices[1].normal = glm::normalize(glm::vec3(-0.5F, 0.5F, 0.7F));
        scene.model.vertices[3].normal = glm::normalize(glm::vec3(0.5F, -0.5F, 0.7F));
        return scene.picture(16);
    };
    const glm::ivec4 colour = GENERATE(glm::ivec4(255), glm::ivec4(200, 90, 40, 255));
    TexturedModel textured(glm::ivec2(40, 40));
    textured.model.textures.push_back(uniform(colour));
    const scene::Picture with = lit(textured);
    TexturedModel coloured(glm::ivec2(40, 40));
    coloured.model.textures.push_back(uniform(colour));
    const auto packed = static_cast<std::uint32_t>(colour.x | colour.y << 8 | colour.z << 16) | 0xff000000U;
    lit(coloured);
    for (scene::ModelVertex& vertex : coloured.model.vertices) {
        vertex.colour = vertex.face_colour = packed;
        vertex.texture = 0;
    }
    const scene::Picture without = coloured.picture(16);
    int worst = 0;
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
            worst = std::max(worst, worst_channel(pixel(with, x, y), pixel(without, x, y)));
        }
    }
    CAPTURE(smooth, lights_pixels, visibility_m, colour.x);
    CHECK(worst <= 2);
    textured.plan().aircraft[0].tints = {0xff00ff00U, 0xff00ff00U};
    scene::FramePlan& plan = textured.plan();
    plan.haze.visibility_m = 0.0F;
    plan.ambient = glm::vec3(1.0F);
    plan.sunlight = glm::vec3(0.0F);
    const scene::Picture tinted = drawn(plan, glm::ivec2(40, 40), 16, 1, nullptr, std::span(&textured.model, 1));
    CHECK(pixel(tinted, 20, 20) == glm::ivec3(0, 255, 0));
}

TEST_CASE("light that is too much for a texel is cut off at each pixel") {
    TexturedModel scene(glm::ivec2(30, 30));
    scene.model.textures.push_back(
        texture_of(2, 1, [](int column, int) { return glm::ivec4(column == 0 ? 240 : 100, 0, 0, 255); }));
    scene.add_facing(10.0F, 10.0F);
    scene.plan().ambient = glm::vec3(1.4F);
    const scene::Picture picture = scene.picture(16);
    CHECK(pixel(picture, 2, 15).x == 255);
    CHECK(pixel(picture, 27, 15).x == Approx(140).margin(1));
}

TEST_CASE("a picture may have any size, and places without meaning do no harm") {
    TexturedModel scene(glm::ivec2(33, 21));
    SurfaceTexture texture = texture_of(7, 1, [](int column, int) { return glm::ivec4(30 * column, 9, 9, 255); });
    texture.wrap_u = GENERATE(TextureWrap::Repeat, TextureWrap::Clamp, TextureWrap::Mirror);
    scene.model.textures.push_back(texture);
    const float wild = GENERATE(1e30F, -std::numeric_limits<float>::infinity(), std::nanf(""), 5e5F);
    scene.add({glm::vec3(-8.0F, -8.0F, -8.0F), glm::vec3(9.0F, -9.0F, 2.0F), glm::vec3(9.0F, 9.0F, 2.0F),
                  glm::vec3(-8.0F, 8.0F, -8.0F)},
        {glm::vec2(wild, 0.0F), glm::vec2(1.0F, wild), glm::vec2(wild), glm::vec2(-wild, 0.3F)});
    const scene::Picture picture = scene.picture(16);
    CHECK(count_of(picture, no_light) < 33 * 21);
    CHECK(count_of(picture, full_light) == 0);
}

} // namespace octant::visuals::raster
