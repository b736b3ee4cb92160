#include "models/texture.h"
#include "tests/visuals/gl/small_scene.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

using namespace octant;
using namespace octant::tests;

namespace {

/// Four by four texels: red, green, blue and, lower right, white that is not there, each two by two.
models::SurfaceTexture quarters(models::TextureAlpha alpha, models::TextureWrap wrap = models::TextureWrap::Repeat) {
    constexpr std::array<std::array<std::uint8_t, 4>, 4> colours{
        {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 255, 0}}};
    models::TextureLevel level{4, 4, {}};
    for (std::size_t texel = 0; texel < 16; ++texel) {
        const auto& colour = colours.at(texel / 8 * 2 + texel % 4 / 2);
        level.rgba.insert(level.rgba.end(), colour.begin(), colour.end());
    }
    models::SurfaceTexture texture;
    texture.picture = std::make_shared<const models::TexturePicture>(models::texture_picture("quarters", level));
    texture.wrap_u = texture.wrap_v = wrap;
    texture.alpha = alpha;
    return texture;
}

/// A square with a picture so many times across and down.
scene::ModelBuffers pictured_square(const models::SurfaceTexture& texture, float times = 1.0F) {
    scene::ModelBuffers model = square_model(glm::vec3(1.0F));
    model.textures = {texture};
    for (scene::ModelVertex& vertex : model.vertices) {
        vertex.on_texture = times * glm::vec2(0.5F + 0.5F * vertex.position_m.x, 0.5F - 0.5F * vertex.position_m.y);
        vertex.texture = 1;
    }
    return model;
}

/// The picture of one square that fills it.
scene::Picture picture_of(Studio& studio, const scene::ModelBuffers& model) {
    studio.renderer().load_models({&model, 1});
    scene::FramePlan plan = empty_plan();
    set_square(plan, 0, ahead(1.0F));
    return studio.picture(plan);
}

} // namespace

TEST_CASE("a picture lies upright on an aircraft; a mask leaves holes, opaque ones have none") {
    Studio studio;
    for (const models::TextureAlpha alpha : {models::TextureAlpha::Opaque, models::TextureAlpha::Mask}) {
        const scene::Picture picture = picture_of(studio, pictured_square(quarters(alpha)));
        CHECK(pixel(picture, 14, 14) == red_px);
        CHECK(pixel(picture, 50, 14) == green_px);
        CHECK(pixel(picture, 14, 50) == blue_px);
        const bool is_opaque = alpha == models::TextureAlpha::Opaque;
        CHECK(pixel(picture, 50, 50) == (is_opaque ? Pixel{255, 255, 255, 255} : grey_px));
    }
}

TEST_CASE("beyond its edge a picture repeats or goes on") {
    Studio studio;
    const scene::Picture again = picture_of(studio, pictured_square(quarters(models::TextureAlpha::Opaque), 2.0F));
    CHECK(pixel(again, 7, 7) == red_px);
    CHECK(pixel(again, 39, 7) == red_px);
    CHECK(pixel(again, 57, 39) == green_px);
    const scene::Picture on =
        picture_of(studio, pictured_square(quarters(models::TextureAlpha::Opaque, models::TextureWrap::Clamp), 2.0F));
    CHECK(pixel(on, 7, 7) == red_px);
    CHECK(pixel(on, 57, 7) == green_px);
    CHECK(pixel(on, 7, 57) == blue_px);
}

TEST_CASE("the colour of a vertex tints a picture; a colour shown in its place leaves it out") {
    Studio studio;
    scene::ModelBuffers model = pictured_square(quarters(models::TextureAlpha::Opaque));
    for (scene::ModelVertex& vertex : model.vertices) {
        vertex.colour = vertex.face_colour = models::packed_colour({1.0F, 0.0F, 1.0F});
    }
    const scene::Picture tinted = picture_of(studio, model);
    CHECK(pixel(tinted, 14, 14) == red_px);
    CHECK(pixel(tinted, 50, 14) == Pixel{0, 0, 0, 255});
    scene::FramePlan plan = empty_plan();
    set_square(plan, 0, ahead(1.0F));
    plan.aircraft.front().tints = {0xff00ff00U, 0xff00ff00U};
    CHECK(pixel(studio.picture(plan), 14, 14) == green_px);
}

TEST_CASE("clear surfaces are blended by their opacity times the alpha of their picture") {
    Studio studio;
    const scene::ModelBuffers model = pictured_square(quarters(models::TextureAlpha::Blend));
    studio.renderer().load_models({&model, 1});
    scene::FramePlan plan = empty_plan();
    set_square(plan, 0, ahead(1.0F));
    plan = framed(plan, HiddenSurfaceMode::ByDepth);
    for (scene::PaintStep& step : plan.steps) {
        if (step.content == scene::PaintStep::Content::Aircraft) { step.opacity = 0.5F; }
    }
    scene::Picture picture;
    studio.renderer().draw(plan);
    studio.renderer().finish_and_read(picture);
    CHECK(std::abs(pixel(picture, 14, 14)[0] - 192) <= 1);
    CHECK(std::abs(pixel(picture, 14, 14)[1] - 64) <= 1);
    CHECK(pixel(picture, 50, 50) == grey_px);
}

TEST_CASE("a picture far finer than the pixels shows its mean") {
    models::TextureLevel level{256, 256, {}};
    for (int texel = 0; texel < 256 * 256; ++texel) {
        const auto part = static_cast<std::uint8_t>((texel / 256 + texel) % 2 == 0 ? 0 : 255);
        level.rgba.insert(level.rgba.end(), {part, part, part, 255});
    }
    models::SurfaceTexture texture;
    texture.picture = std::make_shared<const models::TexturePicture>(models::texture_picture("squares", level));
    Studio studio;
    const scene::Picture picture = picture_of(studio, pictured_square(texture, 4.0F));
    for (const int at : {5, 23, 40}) { CHECK(std::abs(pixel(picture, at, 33)[0] - 128) <= 2); }
}
